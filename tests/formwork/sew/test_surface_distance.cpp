#include <catch2/catch.hpp>
#include <random>

#include "formwork/mesher/mesh_kinds.hpp"
#include "formwork/sew/surface_distance.hpp"

using namespace formwork;

TEST_CASE("the tree finds the same closest points as trying every face") {
    const Surface sphere = make_sphere({.radius = 0.1, .edge = 0.02});
    const SurfaceDistance distance(sphere);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(-0.15, 0.35);
    for (int k = 0; k < 300; ++k) {
        const Vector3d q(u(random), u(random), u(random));
        double best = 1e9;
        for (const Triangle& t : sphere.faces)
            best = std::min(best, (closest_on_triangle(q, sphere.x[t[0]], sphere.x[t[1]], sphere.x[t[2]]) - q).norm());
        REQUIRE(std::abs(distance.closest(q).signed_distance) == Approx(best).epsilon(1e-12));
    }
}

TEST_CASE("outside is positive, also beside edges and corners") {
    const Surface sphere = make_sphere({.radius = 0.1, .edge = 0.02});
    const SurfaceDistance distance(sphere);
    const Vector3d centre(0, 0, 0.1);
    for (const Vector3d& x : sphere.x) {
        REQUIRE(distance.closest(centre + 1.2 * (x - centre)).signed_distance == Approx(0.02).epsilon(1e-6));
        REQUIRE(distance.closest(centre + 0.8 * (x - centre)).signed_distance < -0.015);
    }
}

TEST_CASE("the deviation of a grown sphere is its growth") {
    const Surface sphere = make_sphere({.radius = 0.1, .edge = 0.01});
    Surface grown = sphere;
    for (Vector3d& x : grown.x) x = Vector3d(0, 0, 0.1) + 1.03 * (x - Vector3d(0, 0, 0.1));
    const Deviation d = deviation(grown, SurfaceDistance(sphere));
    REQUIRE(d.rms == Approx(0.003).epsilon(0.02));
    REQUIRE(d.max == Approx(0.003).epsilon(0.02));
}
