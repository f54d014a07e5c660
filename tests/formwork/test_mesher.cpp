#include <catch2/catch.hpp>
#include <numbers>

#include "arcsim/base/error.hpp"
#include "arcsim/mesh/topology.hpp"
#include "formwork/mesher/mesh_kinds.hpp"
#include "formwork/mesher/mesh_quality.hpp"

using namespace formwork;
using arcsim::build_topology;

namespace {

double enclosed_volume(const Surface& s) {   // of a closed surface, or one whose rim lies in the plane z = top
    double v = 0, top = -1e30;
    for (const auto& p : s.x) top = std::max(top, p[2]);
    for (int f = 0; f < s.n_faces(); ++f) v += (arcsim::face_centroid(s, f)[2] - top) * arcsim::area_vector(s, f)[2];
    return v;
}

void check_shape(const Surface& s, int loops, int euler) {
    const arcsim::Topology t = build_topology(s);
    CHECK(t.n_components == 1);
    CHECK(t.boundary_loops.size() == static_cast<std::size_t>(loops));
    CHECK(t.euler_characteristic() == euler);
    const MeshQuality q = measure_quality(s);
    INFO("min angle " << q.min_angle_deg << " max " << q.max_angle_deg << " nodes " << s.n_nodes() << " edges " << q.min_edge << " " << q.max_edge);
    CHECK(q.min_angle_deg > 25);
    CHECK(q.max_edge < 2.5 * q.min_edge);
}

}  // namespace

TEST_CASE("Every mesh kind is manifold, oriented outwards, with well shaped triangles") {
    SECTION("disk") {
        const Surface s = make_disk({0.1, 0.008});
        check_shape(s, 1, 1);
        CHECK(arcsim::total_area(s) == Approx(std::numbers::pi * 0.01).epsilon(0.01));
        CHECK(arcsim::area_vector(s, 0)[2] > 0);
    }
    SECTION("strip") {
        const Surface s = make_strip({0.04, 0.02, 0.003});
        check_shape(s, 1, 1);
        CHECK(arcsim::total_area(s) == Approx(0.0008));
    }
    SECTION("sock") {
        const Surface s = make_sock({0.1, 0.3, 0.009});
        check_shape(s, 1, 1);
        CHECK(enclosed_volume(s) == Approx(std::numbers::pi * 0.003).epsilon(0.01));
    }
    SECTION("sphere") {
        const Surface s = make_sphere({0.1, 0.009, 0});
        check_shape(s, 0, 2);
        CHECK(enclosed_volume(s) == Approx(4 * std::numbers::pi / 3 * 0.001).epsilon(0.01));
    }
    SECTION("open sphere") { check_shape(make_sphere({0.1, 0.009, 0.04}), 1, 1); }
    SECTION("column") {
        for (const double edge : {0.0042, 0.006, 0.009}) {
            ColumnSize size;
            size.edge = edge;
            const Surface s = make_column(size);
            check_shape(s, 1, 1);
            CHECK(enclosed_volume(s) > 0);
        }
    }
    SECTION("vase") {
        for (const double edge : {0.003, 0.004, 0.006}) {
            VaseSize size;
            size.edge = edge;
            const Surface s = make_vase(size);
            check_shape(s, 1, 1);
            CHECK(enclosed_volume(s) > 0);
        }
    }
    SECTION("pillow") {
        const ClothMesh m = make_pillow({});
        check_shape(m.surface(), 1, 1);
        CHECK(enclosed_volume(m.surface()) > 0);
        double area = 0;
        for (int f = 0; f < m.n_faces(); ++f) {
            CHECK(m.material_area(f) > 0);
            area += m.material_area(f);
        }
        CHECK(area == Approx(2 * (0.16 * 0.16 + 0.06 * 0.04)).epsilon(0.02));
        for (int f = 0; f < m.n_faces(); ++f)   // the start shape in space is nearly the flat one
            for (int k = 0; k < 3; ++k) {
                const double flat = (m.u[m.face_verts[f][k]] - m.u[m.face_verts[f][(k + 1) % 3]]).norm();
                const double space = (m.x[m.face_nodes[f][k]] - m.x[m.face_nodes[f][(k + 1) % 3]]).norm();
                CHECK(space / flat < 1.35);
                CHECK(space / flat > 0.7);
            }
    }
}

TEST_CASE("Mesh sizes that do not fit are refused") {
    CHECK_THROWS_AS(make_disk({0.1, 0.3}), arcsim::InputError);
    CHECK_THROWS_AS(make_sphere({0.1, 0.01, 0.2}), arcsim::InputError);
    PillowSize narrow;
    narrow.spout_width = 0.01;
    CHECK_THROWS_AS(make_pillow(narrow), arcsim::InputError);
}
