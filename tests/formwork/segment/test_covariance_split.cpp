#include <catch2/catch.hpp>

#include "formwork/segment/covariance_split.hpp"
#include "formwork/segment/developability.hpp"
#include "formwork/segment/panel_patch.hpp"
#include "tests/formwork/segment/sample_surfaces.hpp"

using namespace formwork;

namespace {

/// The half of a sphere above z = 0.1, its nodes renumbered.
Surface dome() {
    const Surface ball = samples::icosphere(3);
    Surface s;
    std::vector<int> number(ball.x.size(), -1);
    for (int f = 0; f < ball.n_faces(); ++f) {
        if (arcsim::face_centroid(ball, f)[2] < 0.1) continue;
        arcsim::Triangle t = ball.faces[f];
        for (int& v : t) {
            if (number[v] < 0) {
                number[v] = s.n_nodes();
                s.x.push_back(ball.x[v]);
            }
            v = number[v];
        }
        s.faces.push_back(t);
    }
    return s;
}

}  // namespace

TEST_CASE("panels above the covariance threshold are split until none is") {
    const Surface s = dome();
    const Topology t = arcsim::build_topology(s);
    REQUIRE(t.euler_characteristic() == 1);
    const std::vector<double> eta = covariance_eta(s, t);
    CutMesh cut(s);
    std::vector<int> panel(s.n_faces(), 0);
    int n_panels = 1;
    const double limit = energy_for_stretch(0.05);
    REQUIRE(panel_energies(t, eta, panel, 1)[0] > limit);
    const int splits = split_by_covariance(cut, panel, n_panels, limit, 50, {});
    CHECK(splits > 2);
    for (double energy : panel_energies(t, eta, panel, n_panels)) CHECK(energy <= limit);
    int labelled = 0;   // the seams in the mesh part it the same way
    label_panels(cut, labelled);
    CHECK(labelled == n_panels);
}

TEST_CASE("the number of panels bounds the splits") {
    const Surface s = dome();
    CutMesh cut(s);
    std::vector<int> panel(s.n_faces(), 0);
    int n_panels = 1;
    split_by_covariance(cut, panel, n_panels, 0.1, 3, {});
    CHECK(n_panels == 3);
}

TEST_CASE("a finished segmentation is split with its seams, and what stays above is named") {
    Segmentation seg;
    seg.mesh = dome();
    seg.panel.assign(seg.mesh.n_faces(), 0);
    seg.n_panels = 1;
    CHECK(split_by_covariance(seg, 2.0, 2, {}) == 1);
    CHECK(seg.n_panels == 2);
    int sewn = 0, rims = 0;
    for (const Seam& seam : seg.seams) ++(seam.is_rim() ? rims : sewn);
    CHECK(sewn == 1);
    CHECK(rims == 2);
    const std::vector<double> energy = panel_energies(seg);
    int above = 0;
    for (double e : energy) above += e > 2.0;
    CHECK(static_cast<int>(seg.violations.size()) == above);
    REQUIRE(above > 0);
    CHECK_THAT(seg.violations[0], Catch::Contains("max_covariance_energy 2"));
}
