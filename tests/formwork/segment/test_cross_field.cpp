#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <functional>
#include <random>

#include "arcsim/base/error.hpp"
#include "formwork/segment/angle_transport.hpp"
#include "formwork/segment/cross_field.hpp"
#include "tests/formwork/segment/sample_surfaces.hpp"

using namespace formwork;
using std::numbers::pi;

namespace {

std::vector<DirectionData> random_directions(int n, unsigned seed, double weight) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> angle(-pi, pi), share(0, 1);
    std::vector<DirectionData> data(n);
    for (DirectionData& d : data) {
        d.theta = angle(random);
        d.weight = weight * share(random);
    }
    return data;
}

/// Angles of the projection of a vector field of space.
std::vector<DirectionData> projected(const Surface& s, const std::function<arcsim::Vector3d(const arcsim::Vector3d&)>& v,
                                     double weight) {
    std::vector<DirectionData> data(s.n_faces());
    for (int f = 0; f < s.n_faces(); ++f) {
        data[f].theta = arcsim::face_frame(s, f).angle(v(arcsim::face_centroid(s, f)));
        data[f].weight = weight;
    }
    return data;
}

int index_sum4(const std::vector<Singularity>& all) {
    int sum = 0;
    for (const Singularity& x : all) sum += x.index4;
    return sum;
}

struct Sample {
    std::string name;
    Surface surface;
    int euler;
    int loops;
};

std::vector<Sample> samples_of_every_kind() {
    const auto all = [](int, int, int) { return true; };
    std::vector<Sample> list;
    list.push_back({"sphere", samples::icosphere(2), 2, 0});
    list.push_back({"torus", samples::torus(24, 12, 2, 1), 0, 0});
    for (int genus = 0; genus <= 3; ++genus)
        list.push_back({"genus " + std::to_string(genus), samples::slab_with_holes(genus), 2 - 2 * genus, 0});
    list.push_back({"disk", samples::grid(7, 5, 0.2), 1, 1});
    list.push_back({"tube", samples::tube(16, 6, 1, 2), 0, 2});
    list.push_back({"box without lid", samples::cubes(2, 2, 2, 3, all,
                    [](int, int, int k, int axis, int side) { return k == 1 && axis == 2 && side == 1; }), 1, 1});
    list.push_back({"box with three windows", samples::cubes(3, 3, 3, 3, all,
                    [](int i, int j, int k, int axis, int) {
                        return axis == 0 ? j == 1 && k == 1 : axis == 1 && i == 1 && k == 1 && j == 0; }), -1, 3});
    list.push_back({"ring with a window", samples::cubes(3, 3, 1, 3, [](int i, int j, int) { return i != 1 || j != 1; },
                    [](int i, int j, int, int axis, int side) { return i == 0 && j == 0 && axis == 2 && side == 1; }), -1, 1});
    return list;
}

}  // namespace

TEST_CASE("angles go around a node and come back turned by its curvature") {
    const Surface s = samples::icosphere(1);
    const Topology t = arcsim::build_topology(s);
    const std::vector<double> kappa = transport_angles(s, t), defect = angle_defects(s, t);
    double total = 0;
    for (int v = 0; v < s.n_nodes(); ++v) {
        double turned = 0;
        for (const FanStep& step : fan_steps(s, t, v)) turned += step.sign * kappa[step.edge];
        CHECK(std::remainder(turned - defect[v], 2 * pi) == Approx(0).margin(1e-12));
        total += defect[v];
    }
    CHECK(total == Approx(4 * pi));
}

TEST_CASE("a direction of space transported over a flat sheet keeps its direction") {
    Surface s = samples::grid(4, 3, 0.1);
    std::rotate(s.faces[3].begin(), s.faces[3].begin() + 1, s.faces[3].end());   // frames that differ
    const Topology t = arcsim::build_topology(s);
    const std::vector<double> kappa = transport_angles(s, t);
    const arcsim::Vector3d d(0.6, 0.8, 0);
    for (std::size_t e = 0; e < t.edges.size(); ++e) {
        if (t.edges[e].is_boundary()) continue;
        const double here = arcsim::face_frame(s, t.edges[e].face[0]).angle(d);
        const double there = arcsim::face_frame(s, t.edges[e].face[1]).angle(d);
        CHECK(std::remainder(here + kappa[e] - there, 2 * pi) == Approx(0).margin(1e-12));
    }
}

TEST_CASE("index sum and boundary turning add up to the Euler characteristic on every kind of surface") {
    for (const Sample& sample : samples_of_every_kind()) {
        INFO(sample.name);
        const Topology t = arcsim::build_topology(sample.surface);
        REQUIRE(t.euler_characteristic() == sample.euler);
        REQUIRE(static_cast<int>(t.boundary_loops.size()) == sample.loops);
        for (unsigned seed = 1; seed <= 3; ++seed) {
            const auto data = random_directions(sample.surface.n_faces(), seed, 1);
            std::vector<double> raw;
            for (const DirectionData& d : data) raw.push_back(d.theta);
            for (const CrossField& field : {match_cross_field(sample.surface, t, raw, data, {}),
                                            smooth_cross_field(sample.surface, t, data, {})}) {
                const int sum4 = index_sum4(find_singularities(sample.surface, t, field));
                CHECK(sum4 + boundary_turning4(sample.surface, t, field) == 4 * sample.euler);
            }
        }
    }
}

TEST_CASE("each rim's turning is told apart") {
    const Surface s = samples::tube(16, 6, 1, 2);   // field along the axis: neither rim turns against it
    const Topology t = arcsim::build_topology(s);
    const auto along = projected(s, [](const auto&) { return arcsim::Vector3d::UnitZ(); }, 1);
    const CrossField field = smooth_cross_field(s, t, along, {});
    CHECK(find_singularities(s, t, field).empty());
    CHECK(loop_turning4(s, t, field) == std::vector<int>{0, 0});
    CHECK(field.smoothness_energy == Approx(0).margin(1e-12));

    const Surface disk = samples::grid(6, 6, 0.1);  // a square in a constant field: one whole turn
    const Topology td = arcsim::build_topology(disk);
    const auto straight = projected(disk, [](const auto&) { return arcsim::Vector3d(1, 2, 0); }, 1);
    CHECK(loop_turning4(disk, td, smooth_cross_field(disk, td, straight, {})) == std::vector<int>{4});
}

TEST_CASE("the smoothest cross field of a sphere has eight singularities of valence 3") {
    const Surface s = samples::icosphere(3);
    const Topology t = arcsim::build_topology(s);
    const std::vector<DirectionData> nothing(s.n_faces());
    const CrossField field = smooth_cross_field(s, t, nothing, {});
    const auto found = find_singularities(s, t, field);
    CHECK(found.size() == 8);
    for (const Singularity& x : found) CHECK(x.valence() == 3);
}

TEST_CASE("a torus with directions around its tube has no singularity") {
    const Surface s = samples::torus(40, 16, 2, 0.7);
    const Topology t = arcsim::build_topology(s);
    const auto data = projected(s, [](const arcsim::Vector3d& x) { return arcsim::Vector3d(-x[1], x[0], 0); }, 1);
    const CrossField field = smooth_cross_field(s, t, data, {});
    CHECK(find_singularities(s, t, field).empty());
    CHECK(field.deviation_deg < 1);
}

TEST_CASE("hard directions are kept to the letter") {
    const Surface s = samples::grid(8, 8, 0.1);
    const Topology t = arcsim::build_topology(s);
    const auto data = projected(s, [](const auto&) { return arcsim::Vector3d::UnitX(); }, 1);
    FieldParams params;
    params.hard = {{20, 0.4}, {21, 0.3}, {90, -0.2}};
    const CrossField field = smooth_cross_field(s, t, data, params);
    for (const HardDirection& h : params.hard)
        CHECK(wrap_quarter(field.theta[h.face] - h.theta) == Approx(0).margin(1e-12));
    CHECK(find_singularities(s, t, field).size() % 2 == 0);
}

TEST_CASE("bad directions are named") {
    const Surface s = samples::grid(2, 2, 0.1);
    const Topology t = arcsim::build_topology(s);
    CHECK_THROWS_WITH(smooth_cross_field(s, t, std::vector<DirectionData>(3), {}),
                      Catch::Contains("directions for 3 faces, the mesh has 8"));
    std::vector<DirectionData> data(8);
    data[5].theta = std::nan("");
    CHECK_THROWS_WITH(smooth_cross_field(s, t, data, {}), Catch::Contains("face 5"));
    FieldParams params;
    params.hard = {{8, 0.0}};
    CHECK_THROWS_AS(smooth_cross_field(s, t, std::vector<DirectionData>(8), params), arcsim::InputError);
}

TEST_CASE("the second pass fills isotropic regions from anisotropic ones") {
    const Surface s = samples::grid(12, 6, 0.1);
    const Topology t = arcsim::build_topology(s);
    auto data = projected(s, [](const arcsim::Vector3d&) { return arcsim::Vector3d::UnitX(); }, 1);
    for (int f = 0; f < s.n_faces(); ++f)   // the right half hardly prefers another direction
        if (arcsim::face_centroid(s, f)[0] > 0.6) {
            data[f].theta += 0.6;
            data[f].weight = 0.05;
        }
    FieldParams params;
    params.alpha = 10;
    const auto turned = [&](const CrossField& field) {
        double most = 0;
        for (int f = 0; f < s.n_faces(); ++f)
            most = std::max(most, std::abs(wrap_quarter(field.theta[f] - arcsim::face_frame(s, f).angle({1, 0, 0}))));
        return most;
    };
    CHECK(turned(smooth_cross_field(s, t, data, params)) > 0.3);
    params.isotropic_below = 0.1;
    CHECK(turned(smooth_cross_field(s, t, data, params)) < 0.1);
}

TEST_CASE("each component without data has a field of its own") {
    Surface s = samples::icosphere(1);
    const Surface other = samples::grid(3, 3, 0.2);
    for (auto f : other.faces) {
        for (int& v : f) v += s.n_nodes();
        s.faces.push_back(f);
    }
    s.x.insert(s.x.end(), other.x.begin(), other.x.end());
    const Topology t = arcsim::build_topology(s);
    std::vector<DirectionData> data(s.n_faces());
    const CrossField nothing = smooth_cross_field(s, t, data, {});
    CHECK(index_sum4(find_singularities(s, t, nothing)) == 8);
    for (int f = s.n_faces() - 10; f < s.n_faces(); ++f) data[f].weight = 1;
    CHECK(index_sum4(find_singularities(s, t, smooth_cross_field(s, t, data, {}))) == 8);
}

TEST_CASE("the field turns with the body and keeps its energy when the faces are renumbered") {
    Surface s = samples::slab_with_holes(1, 4);
    const Topology t = arcsim::build_topology(s);
    const auto direction = [](const arcsim::Vector3d& x) { return arcsim::Vector3d(1, std::sin(x[0]), 0.3); };
    const auto data = projected(s, direction, 1);
    const CrossField field = smooth_cross_field(s, t, data, {});
    Surface moved = s;
    const Eigen::AngleAxisd turn(0.8, arcsim::Vector3d(3, 1, 2).normalized());
    for (auto& x : moved.x) x = 2.5 * (turn * x);
    const CrossField turned = smooth_cross_field(moved, t, data, {});
    CHECK(turned.energy == Approx(field.energy).epsilon(1e-9));
    Surface mixed = s;
    std::vector<DirectionData> mixed_data = data;
    std::mt19937 random(1);
    std::vector<int> order(s.n_faces());
    for (int f = 0; f < s.n_faces(); ++f) order[f] = f;
    std::shuffle(order.begin(), order.end(), random);
    for (int f = 0; f < s.n_faces(); ++f) mixed.faces[f] = s.faces[order[f]], mixed_data[f] = data[order[f]];
    const CrossField renumbered = smooth_cross_field(mixed, arcsim::build_topology(mixed), mixed_data, {});
    CHECK(renumbered.energy == Approx(field.energy).epsilon(0.02));
}
