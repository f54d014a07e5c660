#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <unistd.h>

#include "arcsim/base/error.hpp"
#include "formwork/segment/angle_transport.hpp"
#include "formwork/segment/direction_data.hpp"
#include "tests/formwork/segment/sample_surfaces.hpp"

using namespace formwork;

namespace {

struct TemporaryFile {
    std::filesystem::path path = std::filesystem::temp_directory_path() / ("formwork_field_" + std::to_string(getpid()) + ".txt");
    explicit TemporaryFile(const std::string& text) { std::ofstream(path) << text; }
    ~TemporaryFile() { std::filesystem::remove(path); }
};

std::string failure_of(const std::string& text, const Topology& t) {
    const TemporaryFile file(text);
    try {
        read_field_file(file.path, t, {});
    } catch (const arcsim::InputError& error) {
        return error.what();
    }
    return "none";
}

FaceStrain strain_along(const arcsim::Vector3d& dir, double lambda1, double lambda2) {
    FaceStrain e;
    e.lambda1 = lambda1;
    e.lambda2 = lambda2;
    e.dir = dir.normalized();
    return e;
}

}  // namespace

TEST_CASE("a field file is read with and without weights") {
    const Topology t = arcsim::build_topology(samples::grid(1, 1, 1));
    const TemporaryFile four("# theta s1 s2 weight\n0.5 1.08 1.02 0.7\n\n+1e-1\t1.1 1.0 0\r\n");
    const auto data = read_field_file(four.path, t, {});
    REQUIRE(data.size() == 2);
    CHECK(data[0].theta == 0.5);
    CHECK(data[0].weight == 0.7);
    CHECK(data[1].theta == 0.1);
    CHECK(data[1].s1 == 1.1);
    const TemporaryFile three("0 1.02 1.01\n0 1.00 1.00\n");
    const auto weighed = read_field_file(three.path, t, {});
    CHECK(weighed[0].weight == Approx(0.2));   // a = 0.01, noise 0.01: a0 = 0.02
    CHECK(weighed[1].weight == 0);
}

TEST_CASE("a bad field file is named with its line") {
    const Topology t = arcsim::build_topology(samples::grid(1, 1, 1));
    CHECK_THAT(failure_of("0 1 1 1\n", t), Catch::Contains("has 1 directions, the mesh has 2 faces"));
    CHECK_THAT(failure_of("0 1 1\n0 1 1\n0 1 1\n", t), Catch::Contains("more than 2 directions"));
    CHECK_THAT(failure_of("0 1 1 1\n0 nan 1 1\n", t), Catch::Contains(":2: expected a finite number, got \"nan\""));
    CHECK_THAT(failure_of("0 1 1 1\n0 inf 1 1\n", t), Catch::Contains(":2: expected a finite number"));
    CHECK_THAT(failure_of("0 1,0 1 1\n0 1 1 1\n", t), Catch::Contains(":1: expected a finite number, got \"1,0\""));
    CHECK_THAT(failure_of("0 1\n0 1\n", t), Catch::Contains(":1: expected 3 or 4 numbers, got 2"));
    CHECK_THAT(failure_of("0 1 1\n0 1 1 1\n", t), Catch::Contains(":2: has 4 numbers, the lines before have 3"));
    CHECK_THAT(failure_of("0 1 1 -1\n0 1 1 1\n", t), Catch::Contains(":1: the weight is below 0"));
    CHECK_THAT(failure_of("0 0 1 1\n0 1 1 1\n", t), Catch::Contains(":1: a stretch is not above 0"));
    CHECK_THROWS_AS(read_field_file("/nowhere/field.txt", t, {}), arcsim::InputError);
}

TEST_CASE("an even strain gives its own direction and stretches everywhere") {
    Surface s = samples::grid(5, 4, 0.1);
    std::rotate(s.faces[7].begin(), s.faces[7].begin() + 1, s.faces[7].end());
    const Topology t = arcsim::build_topology(s);
    const arcsim::Vector3d along(std::cos(0.3), std::sin(0.3), 0);
    const auto data = directions_from_strain(s, t, StrainField(s.n_faces(), strain_along(along, 1.1, 1.02)), {});
    for (int f = 0; f < s.n_faces(); ++f) {
        CHECK(std::abs(arcsim::face_frame(s, f).direction(data[f].theta).dot(along)) == Approx(1));
        CHECK(data[f].s1 == Approx(1.1));
        CHECK(data[f].s2 == Approx(1.02));
        CHECK(data[f].weight == Approx(0.0064 / 0.0065));
    }
}

TEST_CASE("noise around an isotropic strain does not become data") {
    const Surface s = samples::icosphere(3);
    const Topology t = arcsim::build_topology(s);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> angle(0, 3.14), size(0, 0.05);
    StrainField strain(s.n_faces()), anisotropic(s.n_faces());
    for (int f = 0; f < s.n_faces(); ++f) {
        const auto frame = arcsim::face_frame(s, f);
        const double d = size(random);
        strain[f] = strain_along(frame.direction(angle(random)), 1.1 + d, 1.1 - d);
        anisotropic[f] = strain_along(frame.direction(frame.angle({0, 0, 1})), 1.3, 1.0);
    }
    double sum = 0, sum_anisotropic = 0;
    for (const DirectionData& d : directions_from_strain(s, t, strain, {})) sum += d.weight;
    for (const DirectionData& d : directions_from_strain(s, t, anisotropic, {})) sum_anisotropic += d.weight;
    CHECK(sum / s.n_faces() < 0.85);
    CHECK(sum_anisotropic / s.n_faces() > 0.99);
}

TEST_CASE("a slack face says nothing and a wrinkled one follows its tension") {
    const Surface s = samples::grid(3, 3, 0.1);
    const Topology t = arcsim::build_topology(s);
    StrainField strain(s.n_faces(), strain_along({1, 0, 0}, 1.1, 0.6));
    for (FaceStrain& e : strain) e.state = FaceState::wrinkled;
    strain[4] = strain_along({0, 1, 0}, 1.4, 0.2);
    strain[4].state = FaceState::slack;
    const auto data = directions_from_strain(s, t, strain, {});
    CHECK(data[4].weight == 0);
    CHECK(data[5].s1 == Approx(1.1));
    CHECK(data[5].s2 == Approx(1.0));   // the folds' shortening is no strain
}

TEST_CASE("strain of another mesh or without numbers is refused") {
    const Surface s = samples::grid(1, 1, 0.1);
    const Topology t = arcsim::build_topology(s);
    CHECK_THROWS_AS(directions_from_strain(s, t, StrainField(3), {}), arcsim::InputError);
    StrainField strain(2);
    strain[1].lambda1 = std::nan("");
    CHECK_THROWS_WITH(directions_from_strain(s, t, strain, {}), Catch::Contains("face 1"));
}
