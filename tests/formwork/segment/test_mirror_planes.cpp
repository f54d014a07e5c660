#include <catch2/catch.hpp>
#include <Eigen/Geometry>
#include <random>

#include "formwork/segment/mirror_planes.hpp"
#include "formwork/segment/nearest_surface.hpp"
#include "tests/formwork/segment/sample_surfaces.hpp"

using namespace formwork;

namespace {

std::vector<MirrorPlane> planes_of(const Surface& s, MirrorParams params = {}) {
    return find_mirror_planes(s, arcsim::build_topology(s), params);
}

}  // namespace

TEST_CASE("a slab has the mirror planes of its sides, a bent one loses one") {
    Surface s = samples::cubes(5, 3, 1, 3, [](int, int, int) { return true; });
    const MirrorParams loose{0.02, 4};   // the triangles' diagonals do not mirror
    auto planes = planes_of(s, loose);
    REQUIRE(planes.size() == 3);
    for (int k = 0; k < 3; ++k) {
        CHECK(std::abs(planes[k].normal[k]) == Approx(1).margin(1e-3));
        CHECK(planes[k].point.dot(planes[k].normal) == Approx(k == 0 ? 2.5 : k == 1 ? 1.5 : 0.5).margin(0.03));
    }
    for (auto& x : s.x) x[2] += 0.1 * (x[0] - 2.5) * (x[0] - 2.5);
    planes = planes_of(s, loose);
    CHECK(planes.size() == 2);   // only z -> 1 - z is lost
    for (const MirrorPlane& p : planes) CHECK(std::abs(p.normal[2]) < 0.1);
}

TEST_CASE("the planes turn with the body") {
    Surface s = samples::cubes(5, 3, 1, 3, [](int, int, int) { return true; });
    const Eigen::AngleAxisd turn(0.7, arcsim::Vector3d(1, 2, 3).normalized());
    for (auto& x : s.x) x = turn * x + arcsim::Vector3d(3, -1, 2);
    const auto planes = planes_of(s, {0.02, 4});
    REQUIRE(planes.size() == 3);
    for (const MirrorPlane& p : planes) {
        const arcsim::Vector3d back = turn.inverse() * p.normal;
        CHECK(back.cwiseAbs().maxCoeff() == Approx(1).margin(1e-3));
    }
}

TEST_CASE("mates of a mesh that mirrors are pairs") {
    const Surface s = samples::icosphere(2);
    const auto planes = planes_of(s);
    REQUIRE(planes.size() == 4);
    CHECK(planes[0].exact);
    for (int v = 0; v < s.n_nodes(); ++v) {
        CHECK(planes[0].mate[planes[0].mate[v]] == v);
        CHECK((planes[0].mirror(s.x[v]) - s.x[planes[0].mate[v]]).norm() < 1e-9);
    }
    CHECK(std::abs(planes[0].normal.dot(planes[1].normal)) < 0.05);   // right angles among equals
}

TEST_CASE("a mirror of the shape is found where the triangles do not match") {
    const Surface s = samples::tube(17, 9, 1, 3);   // an odd number around: no node opposite each
    const auto planes = planes_of(s, {0.02, 4});
    REQUIRE(planes.size() == 4);
    bool across = false;
    for (const MirrorPlane& p : planes) across |= std::abs(p.normal[2]) > 0.99;
    CHECK(across);
}

TEST_CASE("a body without symmetry has no mirror plane") {
    Surface s = samples::icosphere(2);
    for (auto& x : s.x) x = {x[0] * (1 + 0.3 * x[1] + 0.2 * x[2]), 1.3 * x[1] + 0.2 * x[0] * x[2], 0.8 * x[2] + 0.15 * x[0] * x[0] + 0.1 * x[1] * x[1] * x[1]};
    CHECK(planes_of(s).empty());
}

TEST_CASE("the nearest node is the one that a search of all nodes finds") {
    const Surface s = samples::icosphere(2);
    const Topology t = arcsim::build_topology(s);
    const NearestSurface near(s, t);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> where(-2, 2);
    for (int i = 0; i < 200; ++i) {
        const arcsim::Vector3d p(where(random), where(random), where(random));
        int best = 0;
        for (int v = 1; v < s.n_nodes(); ++v)
            if ((s.x[v] - p).norm() < (s.x[best] - p).norm()) best = v;
        CHECK(near.node(p) == best);
        CHECK(near.point(p).distance == Approx(std::abs(p.norm() - 1)).margin(0.03));
    }
}
