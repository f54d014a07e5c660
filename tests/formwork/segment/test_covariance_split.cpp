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
    const double limit = energy_for_stretch(0.05);
    REQUIRE(panel_energies(t, eta, std::vector<int>(s.n_faces(), 0), 1)[0] > limit);
    const int splits = split_by_covariance(cut, limit, 50, {});
    CHECK(splits > 2);
    int n_panels = 0;
    const std::vector<int> panel = label_panels(cut, n_panels);
    CHECK(n_panels == splits + 1);
    for (double energy : panel_energies(t, eta, panel, n_panels)) CHECK(energy <= limit);
}

TEST_CASE("the number of panels bounds the splits") {
    const Surface s = dome();
    CutMesh cut(s);
    split_by_covariance(cut, 0.1, 3, {});
    int n_panels = 0;
    label_panels(cut, n_panels);
    CHECK(n_panels == 3);
}

TEST_CASE("a finished layout is split further, along the field where that fits, and what stays above is named") {
    const Surface s = dome();
    SegmentParams params;
    params.max_distortion = 0.5;
    params.max_panels = 2;
    params.symmetry = Symmetry::off;
    const std::vector<DirectionData> data(s.faces.size(), DirectionData{0, 1.1, 1, 0});   // no direction is asked for
    const Segmentation whole = segment(s, data, params);
    REQUIRE(whole.n_panels == 1);
    const Segmentation seg = split_by_covariance(whole, s, data, params, 2.0, {});
    CHECK(seg.n_panels == 2);
    int sewn = 0, rims = 0;
    for (const Seam& seam : seg.seams) ++(seam.is_rim() ? rims : sewn);
    CHECK(sewn == 1);
    CHECK(rims == 2);
    int above = 0;
    for (double e : panel_energies(seg)) above += e > 2.0;
    int named = 0;
    for (const std::string& text : seg.violations) named += text.find("max_covariance_energy 2") != std::string::npos;
    CHECK(named == above);
    REQUIRE(above > 0);
}
