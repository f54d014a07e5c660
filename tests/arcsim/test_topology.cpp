#include <catch2/catch.hpp>

#include "arcsim/base/error.hpp"
#include "arcsim/mesh/topology.hpp"

using namespace arcsim;

namespace {

Surface tetrahedron() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

Surface square() { return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}; }

}  // namespace

TEST_CASE("a closed tetrahedron has Euler characteristic 2 and no boundary") {
    const Topology t = build_topology(tetrahedron());
    CHECK(t.euler_characteristic() == 2);
    CHECK(t.edges.size() == 6);
    CHECK(t.boundary_loops.empty());
    CHECK(t.n_components == 1);
    for (const auto& fan : t.node_faces) CHECK(fan.size() == 3);
}

TEST_CASE("a square of two triangles has one boundary loop that follows its faces") {
    const Topology t = build_topology(square());
    CHECK(t.euler_characteristic() == 1);
    REQUIRE(t.boundary_loops.size() == 1);
    REQUIRE(t.boundary_loops[0].size() == 4);
    const auto& loop = t.boundary_loops[0];
    for (int i = 0; i < 4; ++i) CHECK((loop[i] + 1) % 4 == loop[(i + 1) % 4]);
}

TEST_CASE("the first face of an edge runs through it from its first node to its second") {
    const Surface s = tetrahedron();
    for (const Edge& e : build_topology(s).edges)
        for (int side = 0; side < 2; ++side) {
            const Triangle& f = s.faces[e.face[side]];
            CHECK(f[(e.corner[side] + 1) % 3] == e.node[side]);
            CHECK(f[(e.corner[side] + 2) % 3] == e.node[1 - side]);
        }
}

TEST_CASE("defects are found and named") {
    Surface flipped = square();
    std::swap(flipped.faces[1][0], flipped.faces[1][1]);
    CHECK(find_defects(flipped).misoriented_edges.size() == 1);
    CHECK_THROWS_AS(build_topology(flipped), InputError);

    Surface fin = square();
    fin.x.push_back({0, 0, 1});
    fin.faces.push_back({0, 2, 4});
    CHECK(find_defects(fin).nonmanifold_edges.size() == 1);

    Surface bow_tie = square();
    bow_tie.x.insert(bow_tie.x.end(), {{2, 2, 0}, {1, 2, 0}});
    bow_tie.faces.push_back({2, 4, 5});
    CHECK(find_defects(bow_tie).nonmanifold_nodes == std::vector<int>{2});

    Surface lonely = square();
    lonely.x.push_back({5, 5, 5});
    CHECK(find_defects(lonely).isolated_nodes == std::vector<int>{4});
    CHECK(find_defects(lonely).empty());
}
