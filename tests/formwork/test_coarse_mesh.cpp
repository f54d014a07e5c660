#include <catch2/catch.hpp>

#include "arcsim/mesh/topology.hpp"
#include "formwork/equilibrium/prolong.hpp"
#include "shapes.hpp"

using namespace formwork;
using arcsim::Vector3d;

TEST_CASE("a coarse mesh is the same surface with a quarter of the nodes, its rim, creases and held nodes in place") {
    const shapes::Bag bag = shapes::sock(0.1, 0.2, 14);
    const CoarseMesh c = coarsen(bag.surface, bag.held, bag.surface.n_nodes() / 4);
    REQUIRE(c.surface.n_nodes() < 0.3 * bag.surface.n_nodes());
    const arcsim::Topology t = arcsim::build_topology(c.surface);
    REQUIRE(t.boundary_loops.size() == 1);
    REQUIRE(t.euler_characteristic() == 1);
    REQUIRE(total_area(c.surface) == Approx(total_area(bag.surface)).epsilon(0.02));
    for (int n : t.boundary_loops[0]) REQUIRE(bag.held[3 * c.fine_node[n]]);
    int on_edge = 0;   // of the flat bottom
    for (const Vector3d& x : c.surface.x) on_edge += std::abs(x[2] + 0.2) < 1e-12 && std::hypot(x[0], x[1]) > 0.1 - 1e-9;
    REQUIRE(on_edge > 20);
    for (int f = 0; f < c.surface.n_faces(); ++f) REQUIRE(arcsim::min_angle(c.surface, f) > 0.15);
    for (std::size_t i = 0; i < c.absorber.size(); ++i) {
        REQUIRE(c.absorber[i] >= 0);
        REQUIRE((c.surface.x[c.absorber[i]] - bag.surface.x[i]).norm() < 0.05);
    }
}

TEST_CASE("displacements are carried to the fine nodes to third order") {
    double previous = 0;
    for (const int rings : {10, 20, 40}) {
        const shapes::Bag bag = shapes::disk(0.1, rings);
        const CoarseMesh c = coarsen(bag.surface, bag.held, bag.surface.n_nodes() / 4);
        const auto field = [](const Vector3d& x) {
            return Vector3d(std::sin(20 * x[0]), std::cos(15 * x[1]), std::exp(10 * x[0]) * std::sin(10 * x[1]));
        };
        std::vector<Vector3d> u;
        for (const Vector3d& x : c.surface.x) u.push_back(field(x));
        const std::vector<Vector3d> fine = prolong(c, u, bag.surface);
        double error = 0;
        for (std::size_t i = 0; i < fine.size(); ++i) error += (fine[i] - field(bag.surface.x[i])).squaredNorm() / fine.size();
        error = std::sqrt(error);
        if (previous > 0) REQUIRE(error < previous / 4.5);
        previous = error;
    }
}
