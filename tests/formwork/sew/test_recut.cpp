#include <catch2/catch.hpp>

#include "formwork/sew/recut.hpp"
#include "tests/formwork/sew/sewn_sock.hpp"

using namespace formwork;

TEST_CASE("panels cut again from the sewn bag's shape fit it better: less distortion, less shear, held nodes where they were") {
    shapes::Bag bowl = shapes::hemisphere(0.1, 8);
    std::vector<int> quarter;
    for (int f = 0; f < bowl.surface.n_faces(); ++f) {
        const Vector3d c = arcsim::face_centroid(bowl.surface, f);
        quarter.push_back((c.x() > 0) + 2 * (c.y() > 0));
    }
    const SewnSock bag(std::move(bowl), quarter);
    const SewInput all = bag.input(0);
    const auto input = [&](const Segmentation& s, const std::vector<FlatPanel>& panels) {
        return SewInput{s, panels, all.input_faces, all.inflated, all.input_fixed, all.up, all.plaster, {}, {}, {}};
    };
    struct Cut {
        Segmentation s;
        PanelSet set;
        SewResult sewn;
    };
    const auto cut = [&](int rounds) {
        PanelParams params;
        params.recut = rounds;
        Segmentation s = bag.cut;
        PanelSet set = recut_panels(s, params, SewnSock::params(), input);
        SewResult sewn = sew_bag(input(s, set.panels), SewnSock::params());
        return Cut{std::move(s), std::move(set), std::move(sewn)};
    };
    const Cut plain = cut(0), again = cut(1);

    REQUIRE(plain.set.metrics.mean_stretch_distortion > 0.01);
    for (size_t i = 0; i < plain.s.mesh.x.size(); ++i) REQUIRE(plain.s.mesh.x[i] == bag.cut.mesh.x[i]);
    REQUIRE(again.set.metrics.mean_stretch_distortion < 0.7 * plain.set.metrics.mean_stretch_distortion);
    REQUIRE(again.set.metrics.max_seam_length_mismatch < 1e-5);
    REQUIRE(again.sewn.weave.abs_shear.mean < 0.9 * plain.sewn.weave.abs_shear.mean);
    double moved = 0;
    for (size_t i = 0; i < bag.cut.mesh.x.size(); ++i) {
        moved = std::max(moved, (again.s.mesh.x[i] - bag.cut.mesh.x[i]).norm());
        for (int axis = 0; axis < 3; ++axis)
            if (all.input_fixed[3 * i + axis]) REQUIRE(again.s.mesh.x[i][axis] == bag.cut.mesh.x[i][axis]);
    }
    REQUIRE(moved > 1e-4);
    REQUIRE(moved < 0.02);
}

TEST_CASE("a grain that follows the sewn bag's tension finds the axis and the hoops of a sock again, whatever it was told first") {
    const SewnSock sock(0.1, 0.15, 14);
    const SewInput all = sock.input(0);
    const auto input = [&](const Segmentation& s, const std::vector<FlatPanel>& panels) {
        return SewInput{s, panels, all.input_faces, all.inflated, all.input_fixed, all.up, all.plaster, {}, {}, {}};
    };
    Segmentation told = sock.cut;
    for (DirectionData& d : told.direction) d.theta += 0.3;   // rad; 17 degrees
    const auto off_axis = [&](PanelSet set) {                  // of the wall's panels, degrees
        measure_panels(set, sock.cut);
        double worst = 0;
        for (int p = 0; p < 4; ++p) worst = std::max(worst, set.panels[p].grain_deviation_deg);
        return worst;
    };
    PanelParams params;
    Segmentation s = told;
    const PanelSet askew = recut_panels(s, params, SewnSock::params(), input);
    REQUIRE(off_axis(askew) == Approx(0.3 * 180 / M_PI));
    const double shear = sew_bag(input(s, askew.panels), SewnSock::params()).weave.taut_mean_abs_shear;

    params.grain = GrainTarget::sewn;
    const PanelSet turned = recut_panels(s, params, SewnSock::params(), input);
    INFO(off_axis(turned));
    REQUIRE(off_axis(turned) < 0.4 * off_axis(askew));   // in one round: stiff yarns that are askew pull the tension after them
    const double after = sew_bag(input(s, turned.panels), SewnSock::params()).weave.taut_mean_abs_shear;
    INFO(shear);
    REQUIRE(after < 0.7 * shear);
    for (size_t i = 0; i < s.mesh.x.size(); ++i) REQUIRE(s.mesh.x[i] == sock.cut.mesh.x[i]);   // recut 0: the shape stays
}
