#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "arcsim/base/error.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/panels/notches.hpp"
#include "formwork/panels/pattern_files.hpp"
#include "formwork/panels/sewing_order.hpp"
#include "formwork/panels/sewn_rest.hpp"
#include "tests/formwork/cut_surfaces.hpp"
#include "tests/output_folder.hpp"

using namespace formwork;

namespace {

Segmentation open_tube() {
    return cut_surfaces::tube_in_strips(24, 10, 0.4, [](double) { return 0.1; }, {0, 0.3, 0.6});
}

/// A plane square in three panels that meet in a T: the seam between the lower two ends on the upper one.
Segmentation tee() {
    const Surface s = disk_meshes::patch(8, 8, [](double a, double b) { return Vector3d(a, b, 0); });
    std::vector<int> label;
    for (int f = 0; f < s.n_faces(); ++f) {
        const Vector3d c = arcsim::face_centroid(s, f);
        label.push_back(c.y() > 0.5 ? 2 : c.x() > 0.5 ? 1 : 0);
    }
    return cut_surfaces::cut_by_labels(s, label);
}

}  // namespace

TEST_CASE("a closed bag is sewn so that its highest seam comes last and every step has a way out") {
    const Segmentation s = cut_surfaces::sphere_in_octants(8, 0.2);
    const PanelSet set = make_panels(s, {});
    for (const Vector3d& up : {Vector3d(0, 0, 1), Vector3d(0, -1, 0)}) {
        const std::vector<SewingStep> order = sewing_order(set, s, up);
        REQUIRE(order.size() == 12);
        CHECK(order.back().kind == StepKind::opening);
        std::vector<char> sewn(12, 0);
        for (const SewingStep& step : order) {
            REQUIRE(step.seams.size() == 1);
            CHECK_FALSE(sewn[step.seams[0]]);
            sewn[step.seams[0]] = 1;
            if (&step != &order.back()) CHECK(step.open_before > 0.1);
        }
        double last = 0;
        for (int node : s.seams[order.back().seams[0]].nodes) last += s.mesh.x[node].dot(up) / s.seams[order.back().seams[0]].nodes.size();
        CHECK(last > 0.1);   // a meridian of the upper half
        int joins = 0;
        for (const SewingStep& step : order) joins += step.kind == StepKind::join;
        CHECK(joins == 7);   // a tree over eight pieces
    }
}

TEST_CASE("of 24 pieces of a closed bag none has to be sewn inside it: 23 joins, a way out at each step, the opening last") {
    const Segmentation s = cut_surfaces::sphere_in_24(3, 0.3);
    const PanelSet set = make_panels(s, {});
    const std::vector<SewingStep> order = sewing_order(set, s, {0, 0, 1});
    REQUIRE(order.size() == 48);
    CHECK(order.back().kind == StepKind::opening);
    CHECK(order.back().open_before < 1e-9);   // nothing else is open: it is what the bag is turned out through
    int joins = 0;
    for (std::size_t k = 0; k + 1 < order.size(); ++k) {
        CHECK(order[k].open_before > 0.1);
        joins += order[k].kind == StepKind::join;
    }
    CHECK(joins == 23);
    std::set<std::string> names, styles;
    for (std::size_t i = 0; i < set.seams.size(); ++i) names.insert(seam_name(set, static_cast<int>(i))), styles.insert(notch_words(notch_style(set.seams[i].style)));
    CHECK(names.size() == 48);
    CHECK(styles.size() == 48);
}

TEST_CASE("an open bag is closed first and hemmed last, once around each rim, the lower before the upper") {
    const Segmentation s = open_tube();
    const PanelSet set = make_panels(s, {});
    const std::vector<SewingStep> order = sewing_order(set, s, {0, 0, 1});
    REQUIRE(order.size() == 5);
    CHECK(order[0].kind == StepKind::join);
    CHECK(order[2].kind == StepKind::close);
    for (int k : {3, 4}) {
        CHECK(order[k].kind == StepKind::hem);
        REQUIRE(order[k].seams.size() == 3);
        CHECK(order[k].panels.size() == 3);
        for (int i = 0; i < 3; ++i) {
            const Seam &rim = s.seams[order[k].seams[i]], &next = s.seams[order[k].seams[(i + 1) % 3]];
            CHECK(rim.nodes.back() == next.nodes.front());
            CHECK((s.mesh.x[rim.nodes[0]].z() > 0.2) == (k == 4));
        }
    }
}

TEST_CASE("a seam that ends in the middle of a straight run is sewn before the run") {
    const Segmentation s = tee();
    const PanelSet set = make_panels(s, {});
    for (const Vector3d& up : {Vector3d(0, 1, 0), Vector3d(0, -1, 0)}) {
        const std::vector<SewingStep> order = sewing_order(set, s, up);
        CHECK(order[0].panels[0] + order[0].panels[1] == 1);   // panels 1 and 2, the stem of the T
    }
}

TEST_CASE("the sewn rest shape shares its nodes, keeps flat areas and names its panels") {
    const Segmentation s = open_tube();
    const PanelSet set = make_panels(s, {});
    const arcsim::ClothMesh cloth = arcsim::parse_obj(arcsim::format_obj(sewn_rest(set, s)), "sewn_rest.obj");
    CHECK(cloth.n_nodes() == s.mesh.n_nodes());
    CHECK(cloth.n_verts() == s.mesh.n_nodes() + 3 * 11);   // three seams of eleven nodes each
    CHECK(cloth.groups == std::vector<std::string>{"P01", "P02", "P03"});
    double area = 0;
    for (int f = 0; f < cloth.n_faces(); ++f) area += cloth.material_area(f);
    CHECK(area == Approx(set.metrics.cloth_area_m2).epsilon(1e-9));
    int held = 0;
    for (int label : cloth.node_label) held += label == 1;
    CHECK(held == 48);
}

TEST_CASE("bad input leaves the pattern folder as it was") {
    const Segmentation s = open_tube();
    const OutputFolder scratch("patterns");
    const auto folder = scratch / "out";
    PanelParams params;
    PanelSet set = make_panels(s, params);
    write_patterns(set, s, make_pattern(set, s, {}), folder);
    const auto before = std::filesystem::last_write_time(folder / "panels.svg");

    set.params.allowances = {{10, 5}};
    CHECK_THROWS_WITH(make_pattern(set, s, {}), Catch::Contains("there is no seam 10") && Catch::Contains("this bag has 9"));
    set.params = params;
    set.params.roll_width_mm = 100;
    CHECK_THROWS_WITH(make_pattern(set, s, {}), Catch::Contains("mm wide across the warp, the roll 100 mm"));
    set.params = params;
    set.params.paper = Paper::a0;
    Pattern long_bag = make_pattern(set, s, {});
    long_bag.pieces[0].cut[0].x() -= 6000;
    CHECK_THROWS_WITH(write_patterns(set, s, long_bag, folder), Catch::Contains("/formwork/panels/paper"));
    CHECK(std::filesystem::last_write_time(folder / "panels.svg") == before);
    for (const auto& entry : std::filesystem::directory_iterator(folder)) CHECK(entry.path().filename().string().find("tmp") == std::string::npos);
    CHECK(std::distance(std::filesystem::directory_iterator(folder), {}) == 10 + 1);   // and the folder of single pieces
    CHECK(std::distance(std::filesystem::directory_iterator(folder / "pieces"), {}) == 3);
}

TEST_CASE("pieces and papers of an earlier run are not left to be cut by mistake") {
    const Segmentation s = open_tube();
    const OutputFolder scratch("stale_patterns");
    const auto folder = scratch / "out";
    std::filesystem::create_directories(folder / "pieces");
    for (const char* name : {"pieces/P07.svg", "pieces/Patch.svg", "panels-a3.pdf"}) std::ofstream(folder / name) << "old";
    const PanelSet set = make_panels(s, {});
    write_patterns(set, s, make_pattern(set, s, {}), folder);
    CHECK_FALSE(std::filesystem::exists(folder / "pieces/P07.svg"));
    CHECK_FALSE(std::filesystem::exists(folder / "panels-a3.pdf"));
    CHECK(std::filesystem::exists(folder / "pieces/Patch.svg"));
    CHECK(std::filesystem::exists(folder / "pieces/P03.svg"));
}

TEST_CASE("warp follows the larger stretch, or the smaller one when asked") {
    Segmentation s = open_tube();
    PanelParams params;
    const auto axial_extent = [&](const PanelSet& set) {
        double high = 0;
        for (const Vector2d& u : set.panels[0].u) high = std::max(high, u.x());
        return high;
    };
    CHECK(axial_extent(make_panels(s, params)) == Approx(0.4).epsilon(1e-4));
    params.warp = WarpAlong::smallest_stretch;
    CHECK(axial_extent(make_panels(s, params)) == Approx(7 * 0.2 * std::sin(M_PI / 24)).epsilon(1e-4));   // seven facets
    params.warp = WarpAlong::largest_stretch;
    for (DirectionData& d : s.direction) d.weight = 0;   // no data: the field, warp along the longer side
    CHECK(axial_extent(make_panels(s, params)) == Approx(0.4).epsilon(1e-4));
    for (DirectionData& d : s.direction) d.weight = 1, d.theta += M_PI / 6;   // helical
    const PanelSet helical = make_panels(s, params);
    CHECK(helical.panels[0].grain_deviation_deg < 1e-3);
    CHECK(axial_extent(helical) > 0.4 * std::cos(M_PI / 6));
}
