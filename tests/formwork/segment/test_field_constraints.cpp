#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <unistd.h>

#include "arcsim/base/error.hpp"
#include "formwork/segment/angle_transport.hpp"
#include "formwork/segment/field_constraints.hpp"
#include "tests/formwork/segment/sample_surfaces.hpp"

using namespace formwork;

TEST_CASE("a stroke fixes the faces under it along its direction") {
    const Surface s = samples::grid(10, 10, 0.1);
    const Topology t = arcsim::build_topology(s);
    const arcsim::Vector3d from(0.1, 0.2, 0.01), to(0.9, 0.7, 0.01);
    const auto hard = hard_directions(s, t, {}, {{from, to}});
    CHECK(hard.size() > 10);
    CHECK(hard.size() < 40);
    for (const HardDirection& h : hard) {
        const double angle = arcsim::face_frame(s, h.face).angle(to - from);
        CHECK(wrap_quarter(h.theta - angle) == Approx(0).margin(1e-9));
    }
    FieldParams params;
    params.hard = hard;
    const CrossField field = smooth_cross_field(s, t, std::vector<DirectionData>(s.n_faces()), params);
    CHECK(field.smoothness_energy == Approx(0).margin(1e-9));   // one direction everywhere
}

TEST_CASE("rims and creases are followed") {
    Surface s = samples::grid(8, 6, 0.1);
    for (auto& x : s.x)
        if (x[0] > 0.41) x[2] = 2 * (x[0] - 0.4);
    const Topology t = arcsim::build_topology(s);
    ConstraintParams rims;
    rims.align_rims = true;
    CHECK(hard_directions(s, t, rims, {}).size() >= 24);   // 28 rim edges, corner faces may have two
    ConstraintParams creases;
    creases.crease_angle_deg = 40;
    const auto hard = hard_directions(s, t, creases, {});
    CHECK(hard.size() == 12);   // two faces at each of six crease edges
    for (const HardDirection& h : hard) {
        const double angle = arcsim::face_frame(s, h.face).angle({0, 1, 0});
        CHECK(wrap_quarter(h.theta - angle) == Approx(0).margin(1e-9));
    }
}

TEST_CASE("a stroke off the surface or a bad file of strokes is named") {
    const Surface s = samples::grid(4, 4, 0.1);
    const Topology t = arcsim::build_topology(s);
    CHECK_THROWS_WITH(hard_directions(s, t, {}, {{{0, 0, 1}, {0.4, 0, 1}}}), Catch::Contains("stroke 0") && Catch::Contains("away from the surface"));
    const auto path = std::filesystem::temp_directory_path() / ("formwork_strokes_" + std::to_string(getpid()) + ".obj");
    const auto reading = [&](const char* text) {
        std::ofstream(path) << text;
        return read_strokes(path);
    };
    CHECK(reading("v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 -1\nl 1 3\n").size() == 2);
    CHECK(reading("v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 -1\n")[0].size() == 3);
    CHECK_THROWS_WITH(reading("v 0 0 0\nl 1 2\n"), Catch::Contains(":2: \"2\" is not the number of a point"));
    CHECK_THROWS_WITH(reading("v 0 0 x\n"), Catch::Contains(":1: expected three coordinates"));
    CHECK_THROWS_WITH(reading("v 0 0 0\n"), Catch::Contains("holds no polyline"));
    std::filesystem::remove(path);
}
