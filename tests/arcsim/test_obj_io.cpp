#include <catch2/catch.hpp>
#include <random>

#include "arcsim/base/error.hpp"
#include "arcsim/mesh/obj_io.hpp"

using namespace arcsim;
using Catch::Contains;

namespace {

const char* everything = R"(# two triangles and a seam
vt 0 0
vt 1 0
vl 7
vt 1 1
vt 5 5   # second vert of node 2
v 0 0 0
ny 0 0 0.5
nv 1 2 3
nl 4
v 1 0 0
v 1 1 0
v 0 1 0
e 1 3
ea 0.25
ed 0.125
el 2
g left
f 1/1 2/2 3/3
tl 1
ts 1 2 3 4
td 0.5
usemtl ignored
g right side
f 1/1 3/4/9 4
)";

std::string message_of(const std::string& text) {
    try {
        parse_obj(text, "m.obj");
    } catch (const InputError& e) {
        return e.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("every keyword of the OBJ dialect is read to its place") {
    const ClothMesh m = parse_obj(everything, "m.obj");
    REQUIRE(m.n_nodes() == 4);
    REQUIRE(m.n_verts() == 5);   // four given, one made from node 4's (x, y)
    REQUIRE(m.n_faces() == 2);
    CHECK(m.vert_label[1] == 7);
    CHECK(m.ny[0] == Vector3d(0, 0, 0.5));
    CHECK(m.ny[1] == m.x[1]);
    CHECK(m.v[0] == Vector3d(1, 2, 3));
    CHECK(m.node_label[0] == 4);
    REQUIRE(m.edges.size() == 1);
    CHECK(m.edges[0].node[1] == 2);
    CHECK(m.edges[0].rest_angle == 0.25);
    CHECK(m.edges[0].damage == 0.125);
    CHECK(m.edges[0].label == 2);
    CHECK(m.face_label == std::vector<int>{1, 0});
    CHECK(m.face_plastic[0](0, 1) == 2);
    CHECK(m.face_damage[0] == 0.5);
    CHECK(m.face_verts[1] == Triangle{0, 3, 4});
    CHECK(m.u[4] == Vector2d(0, 1));
    CHECK(m.groups == std::vector<std::string>{"left", "right side"});
    CHECK(m.face_group == std::vector<int>{0, 1});
    CHECK_FALSE(m.one_vert_per_node());
}

TEST_CASE("what is written reads back to the same doubles") {
    ClothMesh m = parse_obj(everything, "m.obj");
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> mantissa(-1, 1), exponent(-300, 300);
    for (auto& x : m.x)
        for (double& c : x) c = mantissa(random) * std::pow(10, exponent(random));
    m.x[0][0] = 5e-324;
    m.x[0][1] = 0.1;
    const std::string text = format_obj(m);
    const ClothMesh n = parse_obj(text, "again.obj");
    CHECK(n.x == m.x);
    CHECK(n.v == m.v);
    CHECK(n.ny == m.ny);
    CHECK(n.u == m.u);
    CHECK(n.face_verts == m.face_verts);
    CHECK(n.face_group == m.face_group);
    CHECK(n.edges[0].rest_angle == m.edges[0].rest_angle);
    CHECK(format_obj(n) == text);
}

TEST_CASE("verts come before nodes, nodes before edges, edges before faces in a written file") {
    const std::string t = format_obj(parse_obj(everything, "m.obj"));
    CHECK(t.rfind("vt ") < t.find("v 0"));
    CHECK(t.find("ny ") < t.find("nv "));
    CHECK(t.find("nv ") < t.find("nl "));
    CHECK(t.rfind("v 0 1 0") < t.find("e 1 3"));
    CHECK(t.find("el 2") < t.find("f 1/1"));
}

TEST_CASE("a mesh without verts is its own flat rest shape, and polygons become the best fan") {
    // A kite whose corner 1 is far: a fan from node 2 or 4 has the larger smallest angle.
    const ClothMesh m = parse_obj("v 0 0 0\nv 1 -1 0\nv 2 0 0\nv 1 5 0\nf 1 2 3 4\ntl 3\n", "kite.obj");
    REQUIRE(m.n_faces() == 2);
    CHECK(m.face_label == std::vector<int>{3, 3});
    const double angle_best = 0.197;   // atan(1/5), the half angle at the top, cannot be avoided by 2-4
    CHECK(min_angle(m.surface(), 0) >= angle_best);
    CHECK(m.u[0] == Vector2d(0, 0));
    CHECK(m.material_area(0) + m.material_area(1) == Approx(6));
    CHECK(m.one_vert_per_node());
}

TEST_CASE("negative indices, a byte order mark, carriage returns and continued lines are read") {
    const ClothMesh m = parse_obj("\xEF\xBB\xBFv 0 0 0\r\nv +1 0 0\r\nv 0 1e0 0\r\nf -3 -2 \\\r\n -1\r\n", "dos.obj");
    CHECK(m.face_nodes.at(0) == Triangle{0, 1, 2});
    CHECK(m.x[1].x() == 1);
}

TEST_CASE("errors of a mesh file name the file, the line and what is wrong") {
    CHECK_THAT(message_of("v 0 0\n"), Contains("m.obj:1: v: a number is missing"));
    CHECK_THAT(message_of("\nv 0 zero 0\n"), Contains("m.obj:2") && Contains("\"zero\""));
    CHECK_THAT(message_of("v 0 nan 0\n"), Contains("finite"));
    CHECK_THAT(message_of("v 0 1e999 0\n"), Contains("finite"));
    CHECK_THAT(message_of("v 0 0 0\nv 1 0 0\nf 1 2 3\n"), Contains("m.obj:3: node 3 does not exist: 1 to 2 are"));
    CHECK_THAT(message_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1/1 2/2 3/3\n"), Contains("vert 1 does not exist: none is"));
    CHECK_THAT(message_of("v 0 0 0\nv 1 0 0\nf 1 2\n"), Contains("at least 3 corners, got 2"));
    CHECK_THAT(message_of("v 0 0 0\nf 1 0 1\n"), Contains("node 0 does not exist"));
    CHECK_THAT(message_of("v 0 0 0\nf a b c\n"), Contains("index of a node, got \"a\""));
    CHECK_THAT(message_of("nl 1\n"), Contains("\"v\" line before it"));
    CHECK_THROWS_WITH(read_obj("no/such.obj"), Contains("no/such.obj: cannot be opened"));
}
