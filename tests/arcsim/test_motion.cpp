#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "arcsim/base/error.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "arcsim/scene/handles.hpp"
#include "arcsim/scene/morph.hpp"
#include "arcsim/scene/motion.hpp"
#include "tests/output_folder.hpp"

using namespace arcsim;
using Catch::Contains;

namespace {

std::vector<Motion> motions_from(const std::string& text) {
    const JsonDocument document = parse_json(text, "scene.json");
    Warnings warnings;
    return read_motions(JsonNode(document), warnings);
}

}  // namespace

TEST_CASE("a motion of two keys is the smooth ramp 3s² - 2s³ and is held outside") {
    const auto m = motions_from(R"([[{"time": 1, "transform": {"translate": [0,0,0]}},
                                     {"time": 3, "transform": {"translate": [2,0,-4]}}]])");
    REQUIRE(m.size() == 1);
    CHECK(m[0].pose(0).translation == Vector3d(0, 0, 0));
    CHECK(m[0].pose(9).translation == Vector3d(2, 0, -4));
    const double s = 0.3, ramp = 3 * s * s - 2 * s * s * s;
    CHECK(m[0].pose(1 + 2 * s).translation.x() == Approx(2 * ramp));
    CHECK(m[0].pose(2).translation.z() == Approx(-2));
}

TEST_CASE("inner keys take the slope between their neighbours, given velocities win") {
    const auto m = motions_from(R"([[{"time": 0}, {"time": 1, "transform": {"translate": [1,0,0]}},
                                     {"time": 3, "transform": {"translate": [6,0,0]}}],
                                    [{"time": 0, "velocity": {"translate": [4,0,0]}},
                                     {"time": 1, "transform": {"translate": [1,0,0]}, "velocity": {}}]])");
    const double d = 1e-6;
    CHECK((m[0].pose(1 + d).translation.x() - m[0].pose(1 - d).translation.x()) / (2 * d) == Approx(2).epsilon(1e-5));
    CHECK(m[0].pose(1).translation.x() == Approx(1));
    CHECK(m[1].pose(d).translation.x() / d == Approx(4).epsilon(1e-4));
    CHECK(m[1].pose(0.5).scale == Approx(1));        // a velocity's default scale means no change
    CHECK((m[1].pose(1).translation.x() - m[1].pose(1 - d).translation.x()) / d == Approx(0).margin(1e-4));
}

TEST_CASE("poses rotate by degrees about an axis, scale, and invert") {
    const auto m = motions_from(R"([[{"time": 0, "transform": {"rotate": [90, 0, 0, 2], "scale": 3, "translate": [1,0,0]}}]])");
    const Pose p = m[0].pose(0);
    CHECK((p.apply({1, 0, 0}) - Vector3d(1, 3, 0)).norm() < 1e-14);
    CHECK((p.apply_inverse(p.apply({0.3, 0.2, 0.1})) - Vector3d(0.3, 0.2, 0.1)).norm() < 1e-14);
}

TEST_CASE("half way between two rotations is the normalised mean of the quaternions") {
    const auto m = motions_from(R"([[{"time": 0}, {"time": 1, "transform": {"rotate": [90, 0, 0, 1]}}]])");
    const Vector3d x = m[0].pose(0.5).apply({1, 0, 0});
    CHECK(std::atan2(x.y(), x.x()) == Approx(std::numbers::pi / 4));
    CHECK(x.norm() == Approx(1));
}

TEST_CASE("a file of recorded motions gives one motion per body, moved by the transform") {
    const OutputFolder scratch("mot");
    const auto file = scratch / "bodies.mot";
    std::ofstream(file) << "2\n2\n0 0 0  1 0 0 0\n1 0 0  -1 0 0 0\n1\n5 5 5  1 0 0 0\n";
    const auto m = motions_from("{\"motfile\": \"" + file.string() + "\", \"fps\": 2, \"transform\": {\"scale\": 2}}");
    REQUIRE(m.size() == 2);
    CHECK(m[0].pose(0.5).translation == Vector3d(2, 0, 0));
    CHECK(m[0].pose(0.25).rotation().isIdentity(1e-12));   // the sign of the second quaternion was mended
    CHECK(m[1].pose(7).translation == Vector3d(10, 10, 10));
    std::ofstream(file) << "1 3 0 0 0 1 0 0 0";
    CHECK_THROWS_WITH(read_mot_file(file, 1, {}), Contains("ends too early"));
}

TEST_CASE("a morph's shapes follow the cubic of motions and its stiffness the cubic of logarithms") {
    Morph morph;
    for (double x : {0.0, 1.0, 6.0}) morph.targets.push_back(VectorXd::Constant(6, x));
    morph.keys = {{0, 0, 10}, {1, 1, 1000}, {3, 2, 10}};
    const auto motion = motions_from(R"([[{"time": 0}, {"time": 1, "transform": {"translate": [1,0,0]}},
                                         {"time": 3, "transform": {"translate": [6,0,0]}}]])");
    VectorXd shape;
    for (double time : {-1.0, 0.0, 0.3, 1.0, 1.7, 2.9, 3.0, 8.0}) {
        const double stiffness = morph.at(time, shape);
        INFO(time);
        CHECK(shape[5] == Approx(motion[0].pose(time).translation.x()).margin(1e-14));
        if (time <= 0 || time >= 3) CHECK(stiffness == Approx(10));
    }
    CHECK(morph.at(1, shape) == Approx(1000));
    CHECK(morph.at(0.5, shape) > 90);   // half way in the logarithm is 100, of the values 505
    CHECK(morph.at(0.5, shape) < 150);
    std::vector<SpringForce::Target> springs;
    morph.add_springs(1, springs);
    REQUIRE(springs.size() == 2);
    CHECK(springs[1].node == 1);
    CHECK(springs[1].stiffness == Approx(1000));
    CHECK(springs[1].position == Vector3d(1, 1, 1));
}

TEST_CASE("errors of motions name the keyframe") {
    CHECK_THROWS_WITH(motions_from(R"([[{"time": 1}, {"time": 1}]])"), Contains("/0/1/time") && Contains("after the keyframe"));
    CHECK_THROWS_WITH(motions_from(R"([[]])"), Contains("at least one keyframe"));
    CHECK_THROWS_WITH(motions_from(R"([[{"time": 0, "transfrom": {}}]])"), Contains("Did you mean \"transform\""));
}

TEST_CASE("a circle's springs are as stiff as the edges beside them that have its label; without such edges, those between labelled nodes") {
    const std::string nodes = "v 0 0 0\nnl 2\nv 1 0 0\nnl 2\nv 1 2 0\nnl 2\n", face = "f 1 2 3\n";
    SceneParams scene;
    scene.cloths.resize(1);
    HandleParams circle;
    circle.type = HandleType::circle;
    circle.label = 2;
    circle.circumference = 6;
    scene.handles = {circle};
    const std::vector<Motion> motions;
    const auto stiffness = [&](const std::string& edges) {
        const ClothMesh mesh = parse_obj(nodes + edges + face, "circle.obj");
        ClothModel model;
        Handles(scene, 0, mesh, motions).update(0, VectorXd::Zero(9), model);
        std::vector<double> k;
        for (const auto& t : model.springs.targets()) k.push_back(t.stiffness / scene.magic.handle_stiffness);
        return k;
    };
    CHECK(stiffness("e 1 2\nel 2\ne 2 3\nel 2\n") == std::vector<double>{1, 3, 2});
    CHECK(stiffness("e 1 2\nel 5\n")[1] == Approx(3));
    CHECK(stiffness("")[0] == Approx(1 + std::sqrt(5)));
}

TEST_CASE("a handle's strength is 1 while it holds and fades with the fourth power") {
    HandleParams p;
    p.start_time = 1;
    p.end_time = 2;
    p.fade_time = 0.5;
    CHECK(Handles::strength(p, 0.99) == 0);
    CHECK(Handles::strength(p, 1) == 1);
    CHECK(Handles::strength(p, 2) == 1);
    CHECK(Handles::strength(p, 2.25) == Approx(std::pow(0.5, 4)));
    CHECK(Handles::strength(p, 2.5) == 0);
}
