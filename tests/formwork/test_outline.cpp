#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "formwork/segment/flat_outline.hpp"
#include "formwork/segment/panel_outline.hpp"
#include "tests/formwork/disk_meshes.hpp"
#include "tests/formwork/layout_meshes.hpp"

using namespace formwork;
using namespace layout_meshes;

namespace {

/// A cone of half opening angle `half`, m along its side 0.3: the cap's rings laid on it.
Surface cone(double half, int sectors = 36) {
    Surface s = disk_meshes::cap(24, sectors, 1);
    for (Vector3d& x : s.x) {
        const double side = 0.3 * std::acos(std::min(1., x.z())), a = std::atan2(x.y(), x.x());
        x = {side * std::sin(half) * std::cos(a), side * std::sin(half) * std::sin(a), -side * std::cos(half)};
    }
    return s;
}

std::vector<int> every_face(const Surface& s) {
    std::vector<int> all(s.faces.size());
    for (std::size_t f = 0; f < all.size(); ++f) all[f] = static_cast<int>(f);
    return all;
}

}  // namespace

TEST_CASE("a cone becomes one panel with a dart, and the dart counts no corners") {
    const Surface s = cone(0.4);
    SegmentParams params;
    params.symmetry = Symmetry::off;
    params.max_panels = 1;
    const Segmentation r = segment(s, along(s, {0.1, 0, 1}, 0.5), params);
    CHECK(r.violations.empty());
    CHECK(r.n_panels == 1);
    CutMesh cut(s);
    for (int ring = 0, v = 0; ring < 24; ++ring) {   // from the tip to the rim
        const int next = 1 + ring * 36;
        cut.mark_seam(v, next);
        v = next;
    }
    const PanelPatch patch = extract_patch(cut, every_face(s));
    REQUIRE(patch.is_disk());
    CHECK(corner_nodes(patch).empty());
}

TEST_CASE("a cone takes its dart also where all vertices around its tip are singular") {
    SegmentParams params;
    params.symmetry = Symmetry::off;
    params.max_panels = 1;
    for (const auto& [half, sectors] : {std::pair{0.3, 30}, std::pair{0.4, 41}, std::pair{0.6, 36}}) {   // mending leaves three faces at some tips
        const Surface s = cone(half, sectors);
        const Segmentation r = segment(s, along(s, {0.1, 0, 1}, 0.5), params);
        CHECK(r.violations.empty());
        CHECK(r.n_panels == 1);
    }
}

TEST_CASE("folds that part the surface are tried as seams") {
    const double r = 0.1;
    const Surface s = grid(32, 16, true, false, [&](double u, double v) {   // a tube of square section, its folds along z
        const int side = static_cast<int>(4 * u + 1e-9) % 4;
        const double t = r * (2 * (4 * u - std::floor(4 * u + 1e-9)) - 1);
        const double x[] = {r, -t, -r, t}, y[] = {t, r, -t, -r};
        return Vector3d(x[side], y[side], 0.4 * v);
    });
    SegmentParams params;
    params.constraints.crease_angle_deg = 40;
    const Segmentation found = segment(s, along(s, {0, 0, 1}, 0.5), params);
    CHECK(found.violations.empty());
    int n_seams = 0;
    for (const Seam& seam : found.seams) {
        if (seam.is_rim()) continue;
        ++n_seams;
        for (int v : seam.nodes) CHECK((std::abs(std::abs(found.mesh.x[v].x()) - r) < 1e-9 && std::abs(std::abs(found.mesh.x[v].y()) - r) < 1e-9));
    }
    CHECK(n_seams >= 1);
}

TEST_CASE("inlets, necks and tips of a flat outline are seen") {
    // A square of 1 m with an inlet of 0.02 m width and 0.6 m depth, then a dumbbell with a neck of 0.1 m.
    const std::vector<Vector2d> inlet{{0, 0}, {1, 0}, {1, 1}, {0.51, 1}, {0.51, 0.4}, {0.49, 0.4}, {0.49, 1}, {0, 1}};
    CHECK(outline_gaps(inlet, 0.1).inlet == Approx(0.02));
    const std::vector<Vector2d> neck{{0, 0}, {0.4, 0}, {0.4, 0.45}, {0.6, 0.45}, {0.6, 0}, {1, 0}, {1, 1}, {0.6, 1}, {0.6, 0.55}, {0.4, 0.55}, {0.4, 1}, {0, 1}};
    CHECK(outline_gaps(neck, 0.3).neck == Approx(0.1 / 0.6));
    CHECK(outline_gaps(neck, 0.1).neck > 0.4);   // wide enough by that measure
    const double half = 0.15;
    std::vector<Vector2d> tip;   // a sector, with nodes along its sides
    for (int i = 0; i < 20; ++i) tip.emplace_back(0.05 * i * std::cos(half), -0.05 * i * std::sin(half));
    for (int i = -10; i <= 10; ++i) tip.emplace_back(std::cos(half * i / 10), std::sin(half * i / 10));
    for (int i = 19; i > 0; --i) tip.emplace_back(0.05 * i * std::cos(half), 0.05 * i * std::sin(half));
    CHECK(outline_gaps(tip, 0.3).neck == Approx(std::sin(half)).epsilon(0.2));
    CHECK(outline_gaps({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.1).inlet == std::numeric_limits<double>::infinity());
    CHECK(solidity(inlet) == Approx(1 - 0.02 * 0.6));
}
