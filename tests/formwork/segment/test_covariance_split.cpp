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
