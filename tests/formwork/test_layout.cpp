#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <set>

#include "arcsim/base/error.hpp"
#include "formwork/flatten/flatten.hpp"
#include "formwork/segment/layout_json.hpp"
#include "formwork/segment/panel_outline.hpp"
#include "tests/formwork/layout_meshes.hpp"
#include "tests/output_folder.hpp"

using namespace formwork;
using namespace layout_meshes;
using arcsim::Vector3d;

namespace {

CutMesh with_borders(const Segmentation& r) {
    CutMesh cut(r.mesh);
    for (const Seam& seam : r.seams)
        for (std::size_t i = 0; i + 1 < seam.nodes.size(); ++i)
            if (!seam.is_rim()) cut.mark_seam(seam.nodes[i], seam.nodes[i + 1]);
    return cut;
}

/// What every segmentation promises, whatever the surface.
void check_promises(const Surface& s, const Segmentation& r) {
    const Topology t = arcsim::build_topology(r.mesh);
    CHECK(t.euler_characteristic() == arcsim::build_topology(s).euler_characteristic());
    CHECK(arcsim::total_area(r.mesh) == Approx(arcsim::total_area(s)).epsilon(5e-3));
    REQUIRE(r.panel.size() == r.mesh.faces.size());
    REQUIRE(r.source_face.size() == r.mesh.faces.size());
    REQUIRE(r.source.size() == r.mesh.x.size());
    REQUIRE(r.field_theta.size() == r.mesh.faces.size());
    REQUIRE(r.direction.size() == r.mesh.faces.size());

    // Every face has one of the panels, and every panel is a disk.
    const CutMesh cut = with_borders(r);
    CHECK(*std::min_element(r.panel.begin(), r.panel.end()) == 0);
    CHECK(*std::max_element(r.panel.begin(), r.panel.end()) == r.n_panels - 1);
    int n_walked = 0;
    label_panels(cut, n_walked);
    CHECK(n_walked == r.n_panels);
    for (const auto& faces : panel_faces(r.panel, r.n_panels)) {
        const PanelPatch patch = extract_patch(cut, faces);
        CHECK(patch.is_disk());
        const Topology built = arcsim::build_topology(patch.surface);   // taken from the cut mesh, as found from the faces alone
        CHECK(patch.topology.face_edges == built.face_edges);
        CHECK(patch.topology.node_faces == built.node_faces);
        CHECK(patch.topology.boundary_loops == built.boundary_loops);
    }

    // Each border edge lies in exactly one seam, with the right panel on each side.
    std::set<std::pair<int, int>> seen;
    for (const Seam& seam : r.seams)
        for (std::size_t i = 0; i + 1 < seam.nodes.size(); ++i) {
            const int a = seam.nodes[i], b = seam.nodes[i + 1];
            CHECK(seen.insert(std::minmax(a, b)).second);
            const int left = cut.face_left(a, b), right = cut.face_left(b, a);
            REQUIRE(left >= 0);
            CHECK(r.panel[left] == seam.panel[0]);
            CHECK((right < 0 ? -1 : r.panel[right]) == seam.panel[1]);
        }
    std::size_t n_borders = 0;
    for (const arcsim::Edge& e : t.edges)
        n_borders += e.is_boundary() || r.panel[e.face[0]] != r.panel[e.face[1]] || cut.is_seam(e.node[0], e.node[1]);
    CHECK(seen.size() == n_borders);

    // Nodes lie on the input surface, where their source says.
    for (int v = 0; v < r.mesh.n_nodes(); ++v) {
        Vector3d x = Vector3d::Zero();
        for (int k = 0; k < 3; ++k) x += r.source[v].barycentric[k] * s.x[s.faces[r.source[v].face][k]];
        CHECK((x - r.mesh.x[v]).norm() < 1e-9);
    }
    for (int f = 0; f < r.mesh.n_faces(); ++f)
        CHECK(arcsim::face_normal(r.mesh, f).dot(arcsim::face_normal(s, r.source_face[f])) > 0.5);
}

double smallest_angle_deg(const Surface& s) {
    double least = 180;
    for (int f = 0; f < s.n_faces(); ++f) least = std::min(least, arcsim::min_angle(s, f) * 180 / std::numbers::pi);
    return least;
}

}  // namespace

TEST_CASE("a tube is opened into disks that lie flat without stretch") {
    const Surface s = tube(36, 20, 0.1, 0.3);
    const Segmentation r = segment(s, along(s, {0, 0, 1}, 1), {});
    check_promises(s, r);
    CHECK(r.violations.empty());
    CHECK(r.n_panels <= 2);
}

TEST_CASE("the corners of a sheet count, the teeth of a ragged rim do not") {
    const auto corners = [](const Surface& s) {
        std::vector<int> all(s.faces.size());
        for (std::size_t f = 0; f < all.size(); ++f) all[f] = static_cast<int>(f);
        return corner_nodes(extract_patch(CutMesh(s), all)).size();
    };
    Surface s = grid(40, 40, false, false, [](double u, double v) { return Vector3d(u, v, 0); });
    CHECK(corners(s) == 4);
    for (int i = 1; i < 40; ++i)   // one side with teeth as high as they are wide
        if (i % 2) {
            for (Vector3d& x : s.x)
                if (x[1] == 1 && std::abs(x[0] - i / 40.) < 1e-9) x[1] += 1 / 40.;
        }
    CHECK(corners(s) == 4);
}

TEST_CASE("a cup with one rim becomes few disks") {
    const Surface s = cup(48, 0.1, 0.25);
    const Segmentation r = segment(s, along(s, {0, 0, 1}, 0.5), {});
    check_promises(s, r);
    CHECK(r.violations.empty());
    CHECK(r.n_panels <= 8);
}

TEST_CASE("closed spheres are cut first along a loop") {
    const Surface s = icosphere(4, 0.5);
    const Segmentation r = segment(s, along(s, {0, 0, 1}, 0), {});
    check_promises(s, r);
    CHECK(r.violations.empty());
    CHECK(r.n_panels <= 12);
    int sum = 0;
    for (const Singularity& q : r.singularities) sum += q.index4;
    CHECK(sum == 8);
}

TEST_CASE("a torus without singularities is cut along closed field lines") {
    const Surface s = torus(60, 24, 0.4, 0.12);
    const Segmentation r = segment(s, along(s, {0, 0, 1}, 0.2), {});
    check_promises(s, r);
    CHECK(r.violations.empty());
}

TEST_CASE("a bag with three openings becomes disks") {
    const Surface s = three_way(4, 0.3);
    const Segmentation r = segment(s, along(s, {0, 0, 1}, 0.1), {});
    check_promises(s, r);
}

TEST_CASE("a pillow-like sphere with a small spout becomes disks") {
    const Surface s = open_sphere(4, 0.4, 0.38);
    const Segmentation r = segment(s, along(s, {1, 0, 0}, 0.1), {});
    check_promises(s, r);
    CHECK(smallest_angle_deg(r.mesh) > 8);
}

TEST_CASE("a flat sheet stays one panel") {
    const Surface s = grid(20, 12, false, false, [](double u, double v) { return Vector3d(0.4 * u, 0.3 * v, 0); });
    const Segmentation r = segment(s, along(s, {1, 0, 0}, 1), {});
    check_promises(s, r);
    CHECK(r.n_panels == 1);
    CHECK(r.violations.empty());
}

TEST_CASE("the layout is the same every time") {
    const Surface s = open_sphere(3, 0.4, 0.3);
    const auto data = along(s, {1, 0, 0}, 0.3);
    const Segmentation a = segment(s, data, {}), b = segment(s, data, {});
    CHECK(a.panel == b.panel);
    CHECK(a.mesh.faces == b.mesh.faces);
    CHECK(a.mesh.x == b.mesh.x);
}

TEST_CASE("bounds that cannot be met are named") {
    const Surface s = icosphere(3, 0.5);
    SegmentParams p;
    p.max_panels = 2;
    const Segmentation r = segment(s, along(s, {0, 0, 1}, 0), p);
    check_promises(s, r);
    REQUIRE_FALSE(r.violations.empty());
    CHECK(r.violations[0].find("max_distortion") != std::string::npos);
    int told = 0;   // stretches are those of the flat patterns, however far beyond the bound
    for (const std::string& line : r.violations) {
        int panel = 0;
        double percent = 0;
        if (std::sscanf(line.c_str(), "panel %d: stretch of %lf", &panel, &percent) != 2) continue;
        ++told;
        std::vector<int> faces;
        for (int f = 0; f < r.mesh.n_faces(); ++f)
            if (r.panel[f] == panel - 1) faces.push_back(f);
        const double p95 = flatten_disk(extract_patch(with_borders(r), faces).surface).stretch.p95;
        CHECK(percent == Approx(100 * p95).epsilon(0.02));
    }
    CHECK(told > 0);
}

TEST_CASE("bad input to the segmentation is named") {
    using Catch::Matchers::Contains;
    Surface s = tube(12, 4, 0.1, 0.3);
    auto data = along(s, {0, 0, 1}, 1);
    data.pop_back();
    CHECK_THROWS_WITH(segment(s, data, {}), Contains("95") && Contains("96"));
    data = along(s, {0, 0, 1}, 1);
    data[7].theta = std::nan("");
    CHECK_THROWS_WITH(segment(s, data, {}), Contains("face 8"));
    Surface two = s;
    for (arcsim::Triangle t : s.faces) two.faces.push_back({t[0] + s.n_nodes(), t[1] + s.n_nodes(), t[2] + s.n_nodes()});
    for (const Vector3d& x : s.x) two.x.push_back(x + Vector3d(1, 0, 0));
    CHECK_THROWS_WITH(segment(two, along(two, {0, 0, 1}, 1), {}), Contains("2 components"));
    s.x.emplace_back(9, 9, 9);
    CHECK_THROWS_WITH(segment(s, along(s, {0, 0, 1}, 1), {}), Contains("no face"));
    s.x.pop_back();
    s.faces.push_back(s.faces.front());
    CHECK_THROWS_AS(segment(s, along(s, {0, 0, 1}, 1), {}), arcsim::InputError);
}

TEST_CASE("strokes become seams and stay") {
    const Surface s = tube(48, 24, 0.1, 0.3);
    const OutputFolder scratch("stroke");
    const auto file = scratch / "stroke.obj";
    std::ofstream(file) << "v 0.1 0 0\nv 0.1 0 0.15\nv 0.1 0 0.3\nl 1 2 3\n";
    SegmentParams p;
    p.constraints.strokes.path = file;
    const Segmentation r = segment(s, along(s, {0, 0, 1}, 1), p);
    check_promises(s, r);
    double along_stroke = 0;
    for (const Seam& seam : r.seams)
        for (std::size_t i = 0; i + 1 < seam.nodes.size(); ++i) {
            const Vector3d &a = r.mesh.x[seam.nodes[i]], &b = r.mesh.x[seam.nodes[i + 1]];
            if (!seam.is_rim() && std::hypot(a.x() - 0.1, a.y()) < 0.012 && std::hypot(b.x() - 0.1, b.y()) < 0.012)
                along_stroke += (b - a).norm();
        }
    CHECK(along_stroke > 0.29);
}

TEST_CASE("the layout's arcs bound its panels") {
    const Surface s = open_sphere(3, 0.4, 0.3);
    const Segmentation r = segment(s, along(s, {1, 0, 0}, 0.3), {});
    const arcsim::JsonValue layout = layout_json(r);
    CHECK(layout.find("panels")->items.size() == static_cast<std::size_t>(r.n_panels));
    CHECK(layout.find("arcs")->items.size() == r.seams.size());
    std::size_t sides = 0;
    for (const Seam& seam : r.seams) sides += seam.is_rim() ? 1 : 2;
    std::size_t steps = 0;
    double area = 0;
    for (const arcsim::JsonValue& panel : layout.find("panels")->items) {
        steps += panel.find("outline")->items.size();
        area += panel.find("area_m2")->number;
    }
    CHECK(steps == sides);
    CHECK(area == Approx(arcsim::total_area(r.mesh)));
}

TEST_CASE("a mirror plane of the surface becomes a mirror plane of the layout") {
    Surface s = icosphere(4, 0.5);
    for (Vector3d& x : s.x) x = Vector3d(0.5 * x.x(), 0.8 * x.y() + 0.3 * x.x() * x.x(), x.z() + 0.5 * x.y() * x.y());   // x -> -x only
    const Segmentation r = segment(s, along(s, {0, 0, 1}, 0.3), {});
    check_promises(s, r);
    REQUIRE(r.violations.empty());
    // Each layout node has its image among the layout nodes.
    std::vector<Vector3d> ends;
    for (const Seam& seam : r.seams)
        if (!seam.is_loop())
            for (int v : {seam.nodes.front(), seam.nodes.back()}) ends.push_back(r.mesh.x[v]);
    const double reach = 0.6 * arcsim::mean_edge_length(s);
    for (const Vector3d& x : ends) {
        double least = 1;
        for (const Vector3d& y : ends) least = std::min(least, (Vector3d(-x.x(), x.y(), x.z()) - y).norm());
        CHECK(least < reach);
    }
}
