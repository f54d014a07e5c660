#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "arcsim/base/error.hpp"
#include "formwork/flatten/flatten.hpp"
#include "formwork/panels/notches.hpp"
#include "formwork/panels/panel_set.hpp"
#include "tests/formwork/cut_surfaces.hpp"

using namespace formwork;
using arcsim::Vector3d;
using cut_surfaces::cut_by_labels;
using cut_surfaces::sphere_in_octants;
using cut_surfaces::tube_in_strips;

namespace {

/// A waisted tube in four strips of unequal width: its seams have different flat lengths when each strip
/// is flattened on its own.
Segmentation waisted_column() {
    return tube_in_strips(48, 24, 0.6, [](double t) { return 0.1 + 0.035 * std::cos(2 * M_PI * t) + 0.02 * t; },
                          {0, 0.2, 0.45, 0.8});
}

}  // namespace

TEST_CASE("a cylinder in three strips gives three rectangles, warp along the axis") {
    const Segmentation s = tube_in_strips(36, 12, 0.5, [](double) { return 0.1; }, {0, 0.25, 0.5});
    const PanelSet set = make_panels(s, {});
    REQUIRE(set.panels.size() == 3);
    CHECK(set.metrics.max_stretch_distortion < 1e-5);
    CHECK(set.metrics.max_seam_length_mismatch < 1e-6);
    CHECK(set.metrics.cloth_area_m2 == Approx(set.metrics.rest_area_m2).epsilon(1e-6));
    const double chord = 2 * 0.1 * std::sin(M_PI / 36);
    const std::array<int, 3> facets{9, 9, 18};
    for (const FlatPanel& panel : set.panels) {
        Vector2d high = Vector2d::Zero();
        for (const Vector2d& u : panel.u) high = high.cwiseMax(u);
        CHECK(high.x() == Approx(0.5).epsilon(1e-5));
        CHECK(high.y() == Approx(facets[panel.id] * chord).epsilon(1e-5));
        CHECK(panel.grain_deviation_deg < 1e-3);
        CHECK(panel.grain_coherence == Approx(1).margin(1e-6));
        CHECK_FALSE(panel.overlaps);
    }
    int rims = 0;
    for (const PanelSeam& seam : set.seams) rims += seam.is_rim();
    CHECK(rims == 6);
    CHECK(set.seams.size() == 9);
}

TEST_CASE("both sides of every seam get the same length between any two notches") {
    const Segmentation s = waisted_column();
    const PanelSet set = make_panels(s, {});
    // The solve has work to do: flattened one by one, the sides differ by more than a thousandth.
    double apart = 0;
    for (const PanelSeam& seam : set.seams) {
        if (seam.is_rim()) continue;
        CHECK(seam.mismatch < 1e-5);
        CHECK(seam.local_mismatch < 1e-5);
        CHECK(seam.side[0].length == Approx(seam.rest_length).epsilon(0.05));
        CHECK(seam.side[0].vertex.size() == s.seams[&seam - set.seams.data()].nodes.size());
    }
    for (const FlatPanel& panel : set.panels) {
        Surface surface;
        for (int node : panel.node) surface.x.push_back(s.mesh.x[node]);
        surface.faces = panel.faces;
        const StretchStatistics alone = flatten_disk(surface).stretch;
        CHECK(panel.mean_stretch_distortion < 1.3 * alone.mean + 1e-4);
        CHECK(panel.symmetric_dirichlet >= alone.symmetric_dirichlet - 1e-6);
        apart = std::max(apart, panel.symmetric_dirichlet - alone.symmetric_dirichlet);
    }
    CHECK(apart > 1e-6);
}

TEST_CASE("a sphere in octants keeps its symmetry: eight pieces of one size") {
    const PanelSet set = make_panels(sphere_in_octants(16, 0.15), {});
    REQUIRE(set.panels.size() == 8);
    CHECK(set.seams.size() == 12);
    CHECK(set.metrics.flips == 0);
    CHECK(set.metrics.overlaps == 0);
    CHECK(set.metrics.max_seam_length_mismatch < 1e-5);
    for (const FlatPanel& panel : set.panels) CHECK(panel.area == Approx(set.panels[0].area).epsilon(1e-3));
}

TEST_CASE("notches tell a piece's seams apart and cannot be read backwards") {
    const PanelSet set = make_panels(waisted_column(), {});
    for (const PanelSeam& a : set.seams) {
        if (a.is_rim()) continue;
        REQUIRE_FALSE(a.notch.empty());
        double before = 0, longest = 0, nearest = 1;
        for (double f : a.notch) {
            longest = std::max(longest, f - before);
            before = f;
            for (double g : a.notch) nearest = std::min(nearest, std::abs(f - (1 - g)));
        }
        CHECK(std::max(longest, 1 - before) * a.side[0].length <= 0.1);
        CHECK(nearest * a.rest_length > 0.005);   // reversed, every notch is off by more than 5 mm
        for (const PanelSeam& b : set.seams)
            if (&a != &b && !b.is_rim()) CHECK(a.style != b.style);
    }
}

TEST_CASE("hundreds of seams have notches of their own, also when read backwards") {
    std::set<std::vector<NotchShape>> seen;
    for (int i = 0; i < 300; ++i) {
        const NotchStyle style = notch_style(i);
        std::vector<NotchShape> backwards(style.strokes.rbegin(), style.strokes.rend());
        CHECK(seen.insert(style.strokes).second);
        CHECK((backwards == style.strokes || !seen.count(backwards)));
        CHECK(style.width_mm() <= 25);
    }
}

TEST_CASE("compensation shrinks a piece along warp and weft, and the seams still match") {
    PanelParams params;
    params.compensation = {2, 1};
    const PanelSet set = make_panels(tube_in_strips(36, 12, 0.5, [](double) { return 0.1; }, {0, 0.25, 0.5}), params);
    for (const FlatPanel& panel : set.panels) {
        Vector2d high = Vector2d::Zero();
        for (const Vector2d& u : panel.u) high = high.cwiseMax(u);
        CHECK(high.x() == Approx(0.98 * 0.5).epsilon(1e-5));
        CHECK(panel.area == Approx(0.98 * 0.99 * panel.rest_area).epsilon(1e-5));
    }
    CHECK(set.metrics.max_seam_length_mismatch < 1e-6);

    const PanelSet waisted = make_panels(waisted_column(), params);
    CHECK(waisted.metrics.max_seam_length_mismatch < 1e-5);
}

TEST_CASE("stretch compensation cuts every face smaller by its simulated stretch") {
    PanelParams params;
    params.stretch_compensation = true;
    const PanelSet set = make_panels(tube_in_strips(36, 12, 0.5, [](double) { return 0.1; }, {0, 0.25, 0.5}), params);
    for (const FlatPanel& panel : set.panels) {
        Vector2d high = Vector2d::Zero();
        for (const Vector2d& u : panel.u) high = high.cwiseMax(u);
        CHECK(high.x() == Approx(0.5 / 1.08).epsilon(1e-5));
        CHECK(panel.area == Approx(panel.rest_area / 1.08 / 1.02).epsilon(1e-5));
    }
}

TEST_CASE("a dart's nodes are doubled and its two sides match") {
    const Surface cap = disk_meshes::cap(12, 24, 1.3);
    std::set<std::pair<int, int>> slit;   // along the even rings' meridian it zigzags; any chain will do
    for (int ring = 12; ring > 5; --ring) slit.insert({1 + (ring - 1) * 24, 1 + (ring - 2) * 24});
    const Segmentation s = cut_by_labels(cap, std::vector<int>(cap.n_faces(), 0), slit);
    PanelParams plain;
    plain.peak_weight = 0;   // the mean is compared: it must be what is minimised
    const PanelSet set = make_panels(s, plain);
    REQUIRE(set.panels.size() == 1);
    CHECK(set.panels[0].node.size() == cap.x.size() + 7);
    const PanelSet whole = make_panels(cut_by_labels(cap, std::vector<int>(cap.n_faces(), 0)), plain);
    CHECK(set.metrics.mean_stretch_distortion < 0.8 * whole.metrics.mean_stretch_distortion);
    for (const PanelSeam& seam : set.seams)
        if (!seam.is_rim()) {
            CHECK(seam.side[0].panel == seam.side[1].panel);
            CHECK(seam.local_mismatch < 1e-5);
            CHECK((seam.side[0].vertex.front() == seam.side[1].vertex.front()) != (seam.side[0].vertex.back() == seam.side[1].vertex.back()));
        }
}

TEST_CASE("panels that cannot be made are named by their printed numbers, with a remedy") {
    const Surface ball = disk_meshes::icosphere(2);
    CHECK_THROWS_WITH(make_panels(cut_by_labels(ball, std::vector<int>(ball.n_faces(), 0)), {}),
                      Catch::Contains("panel 1 is no disk") && Catch::Contains("max_panels"));
    PanelParams strict;
    strict.max_distortion = 0.001;
    CHECK_THROWS_WITH(make_panels(sphere_in_octants(8, 0.2), strict),
                      Catch::Contains("panel 1 cannot be laid flat") && Catch::Contains("allowed are 0.1 %"));
    Segmentation torn = waisted_column();
    torn.seams.pop_back();
    CHECK_THROWS_WITH(make_panels(torn, {}), Catch::Contains("belongs to no seam and no rim"));
    Segmentation swapped = waisted_column();
    for (Seam& seam : swapped.seams)
        if (!seam.is_rim()) std::swap(seam.panel[0], seam.panel[1]);
    CHECK_THROWS_WITH(make_panels(swapped, {}), Catch::Contains("does not lie on panel"));
}
