#include <catch2/catch.hpp>
#include <filesystem>

#include "arcsim/base/files.hpp"
#include "formwork/load/cast_solid.hpp"
#include "formwork/load/pressure_force.hpp"
#include "shapes.hpp"
#include "tests/output_folder.hpp"

using namespace formwork;

TEST_CASE("the cast is watertight and holds the liquid's volume, wherever the level is") {
    const Vector3d up(0, 0, 1);
    for (const bool jiggled : {false, true})
        for (const double level : {-0.13, -0.1, -0.061, 0.0, 0.02})
            for (const bool flipped : {false, true}) {
                shapes::Bag bag = shapes::sock(0.1, 0.2, 5);
                if (jiggled) shapes::jiggle(bag.surface.x, {}, 0.004, 2);
                if (flipped)
                    for (auto& f : bag.surface.faces) std::swap(f[1], f[2]);
                const auto x = shapes::flatten(bag.surface.x);
                PressureForce load(bag.surface.faces, up, 1, 0, PressureQuadrature::consistent, PressureJacobian::none);
                const int sign = liquid_orientation(bag.surface.faces, x, up, level);
                load.set_orientation(sign);
                const Surface cast = cast_solid(bag.surface, up, level, sign);
                INFO("level " << level << " jiggled " << jiggled << " flipped " << flipped);
                REQUIRE(open_edges(cast) == 0);
                REQUIRE(enclosed_volume(cast) == Approx(load.totals(x, level).volume).epsilon(1e-9));
            }
}

TEST_CASE("a level that splits the bag into two pools, or rings a cone, closes both") {
    shapes::Bag bag = shapes::disk(0.1, 12);
    for (auto& p : bag.surface.x) p[2] = 0.02 * std::cos(60 * p[0]) - 0.02;       // two troughs
    Surface cast = cast_solid(bag.surface, {0, 0, 1}, -0.03, 1);
    REQUIRE(open_edges(cast) == 0);
    for (auto& p : bag.surface.x) p[2] = 0.02 * std::cos(60 * p.head<2>().norm()) - 0.02;   // a ring around a cone
    cast = cast_solid(bag.surface, {0, 0, 1}, -0.015, 1);
    REQUIRE(open_edges(cast) == 0);
    PressureForce load(bag.surface.faces, {0, 0, 1}, 1, 0, PressureQuadrature::consistent, PressureJacobian::none);
    REQUIRE(enclosed_volume(cast) == Approx(load.totals(shapes::flatten(bag.surface.x), -0.015).volume).epsilon(1e-9));

    const OutputFolder scratch("cast");
    const auto file = scratch / "cast.stl";
    write_stl(file, cast, "cast");
    REQUIRE(arcsim::read_text_file(file).size() == 84 + 50 * cast.faces.size());
}
