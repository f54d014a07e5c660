#include <catch2/catch.hpp>

#include "filled_bag.hpp"

using namespace formwork;

TEST_CASE("a flat disk filled to its rim sags, carries the liquid's weight and stays taut") {
    EquilibriumProblem p = filled_bag(shapes::disk(0.15, 10), 0);
    p.fabric_density = 0.2;
    p.self_weight = true;
    const EquilibriumResult r = find_equilibrium(p);
    REQUIRE(r.converged);
    REQUIRE(r.residual < 1e-8);
    REQUIRE(r.wrinkled_faces == 0);
    REQUIRE(r.regularisation.prestress == 0);
    const double weight = 9.81 * (1500 * r.volume_m3 + 0.2 * total_area(p.rest));
    REQUIRE(r.support_force_N[2] == Approx(weight).epsilon(1e-7));
    REQUIRE(r.support_force_N.head<2>().norm() < 1e-7 * weight);
    REQUIRE(r.volume_m3 == Approx(r.capacity_m3).epsilon(1e-12));
    REQUIRE(r.depth_m == Approx(0.0697).epsilon(0.01));
}

TEST_CASE("a prescribed volume is met together with the shape, from below, at and above the rim's level") {
    for (const double level : {-0.05, 0.0, 0.03}) {
        EquilibriumProblem p = filled_bag(shapes::sock(0.1, 0.15, 6), level);
        const EquilibriumResult by_level = find_equilibrium(p);
        p.plaster.fill->level.reset();
        p.plaster.fill->volume = by_level.volume_m3;
        const EquilibriumResult by_volume = find_equilibrium(p);
        INFO("level " << level);
        REQUIRE(by_volume.fill_level_m == Approx(level).margin(1e-8));
        REQUIRE(largest_difference(by_level, by_volume) < 1e-7);
        REQUIRE(by_volume.volume_m3 == Approx(by_level.volume_m3).epsilon(1e-12));
    }
}

TEST_CASE("a wrinkled bag ends in one shape from every start, and says what the regularisation did") {
    EquilibriumProblem p = filled_bag(shapes::square(0.3, 24), 0.05);
    const EquilibriumResult flat = find_equilibrium(p);
    REQUIRE(flat.wrinkled_faces > 0);
    REQUIRE(flat.regularisation.depth_effect < 1e-3);
    for (const int seed : {1, 2}) {
        p.start = p.rest.x;
        shapes::jiggle(p.start, p.fixed, 1e-3, seed);
        REQUIRE(largest_difference(flat, find_equilibrium(p)) < 1e-9);
    }
    p.start = flat.x;
    REQUIRE(largest_difference(flat, find_equilibrium(p)) < 1e-9);
}

TEST_CASE("where nothing wrinkles the tension field's answer is that of the full law") {
    EquilibriumProblem p = filled_bag(shapes::disk(0.15, 12), 0);
    p.solver.tolerance = 1e-11;
    const EquilibriumResult relaxed = find_equilibrium(p);
    p.material.compression = Compression::full;
    const EquilibriumResult full = find_equilibrium(p);
    REQUIRE(relaxed.wrinkled_faces == 0);
    REQUIRE(largest_difference(relaxed, full) < 1e-10);
}

TEST_CASE("a start on coarser meshes changes the way, not the shape") {
    for (const bool by_volume : {false, true}) {
        EquilibriumProblem p = filled_bag(shapes::disk(0.15, 33), 0);   // 3 367 nodes, taut
        if (by_volume) {
            p.plaster.fill->level.reset();
            p.plaster.fill->volume = 0.003;
        }
        p.solver.tolerance = 1e-10;
        const EquilibriumResult nested = find_equilibrium(p);
        p.solver.nested = false;
        const EquilibriumResult direct = find_equilibrium(p);
        INFO("by volume " << by_volume);
        REQUIRE(nested.coarse_iterations > 0);
        REQUIRE(nested.wrinkled_faces == 0);
        REQUIRE(nested.iterations < direct.iterations);
        REQUIRE(largest_difference(nested, direct) < 1e-8);
    }
}

TEST_CASE("a wrinkled bag that starts on coarser meshes ends in the same shape") {
    EquilibriumProblem p = filled_bag(shapes::square(0.3, 56), 0.05);   // 3 249 nodes
    p.solver.tolerance = 1e-10;
    const EquilibriumResult nested = find_equilibrium(p);
    REQUIRE(nested.coarse_iterations > 0);
    REQUIRE(nested.wrinkled_faces > 0);
    REQUIRE(nested.regularisation.depth_effect < 1e-3);
    p.start = p.rest.x;
    shapes::jiggle(p.start, p.fixed, 1e-3, 3);
    const EquilibriumResult carried_down = find_equilibrium(p);   // a given start is nested too
    REQUIRE(carried_down.coarse_iterations > 0);
    REQUIRE(carried_down.regularisation.prestress == Approx(nested.regularisation.prestress).epsilon(1e-12));
    REQUIRE(largest_difference(nested, carried_down) < 1e-9);
    p.solver.nested = false;
    p.material.prestress = nested.regularisation.prestress;
    p.material.residual = nested.regularisation.residual;
    for (const bool filled : {false, true}) {
        p.start = filled ? carried_down.x : std::vector<Vector3d>{};
        const EquilibriumResult alone = find_equilibrium(p);
        REQUIRE(alone.coarse_iterations == 0);
        REQUIRE(largest_difference(nested, alone) < 1e-9);
    }
}

TEST_CASE("a free rim under the liquid is told, and what the fabric keeps of its compression with it") {
    EquilibriumProblem p = filled_bag(shapes::sock(0.05, 0.1, 4), 0.01);
    for (std::size_t i = 0; i < p.rest.x.size(); ++i)
        for (int c = 0; c < 3; ++c) p.fixed[3 * i + c] = p.rest.x[i][2] < -0.09;
    const EquilibriumResult r = find_equilibrium(p);
    REQUIRE(r.converged);
    REQUIRE(r.residual <= p.solver.tolerance);
    if (r.regularisation.residual > 1e-2) REQUIRE_FALSE(r.warnings.empty());
}

TEST_CASE("solutions depend on rho g a² / k alone") {
    const EquilibriumResult small = find_equilibrium(filled_bag(shapes::disk(0.1, 8), 0));
    EquilibriumProblem p = filled_bag(shapes::disk(0.2, 8), 0);
    p.plaster.density = 1500. / 4;
    const EquilibriumResult large = find_equilibrium(p);
    REQUIRE(large.depth_m == Approx(2 * small.depth_m).epsilon(1e-8));
}

TEST_CASE("an equilibrium that does not exist is never returned") {
    EquilibriumProblem p = filled_bag(shapes::disk(0.15, 6), 0);
    SECTION("free to move") {
        p.fixed.assign(p.fixed.size(), 0);
        REQUIRE_THROWS_WITH(find_equilibrium(p), Catch::Contains("free to move"));
    }
    SECTION("millimetres taken for metres") {
        for (auto& q : p.rest.x) q *= 1000;
        REQUIRE_THROWS_WITH(find_equilibrium(p), Catch::Contains("millimetres"));
    }
    SECTION("ballooning") {
        p = filled_bag(shapes::disk(0.45, 6), 0);
        p.material.max = p.material.rest;
        try {
            find_equilibrium(p);
            FAIL("found an equilibrium");
        } catch (const EquilibriumError& e) {
            REQUIRE_THAT(e.what(), Catch::Contains("ballooning"));
            REQUIRE_FALSE(e.last->converged);
        }
    }
}
