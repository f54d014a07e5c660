#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "arcsim/base/error.hpp"
#include "arcsim/mesh/topology.hpp"
#include "formwork/flatten/flatten.hpp"
#include "formwork/flatten/isometry_energy.hpp"
#include "tests/formwork/disk_meshes.hpp"

using namespace formwork;
using arcsim::Vector3d;
using disk_meshes::cap;
using disk_meshes::patch;

namespace {

std::vector<Vector2d> outline_of(const Surface& s, const std::vector<Vector2d>& u) {
    std::vector<Vector2d> outline;
    const arcsim::Topology topology = arcsim::build_topology(s);
    for (int i : topology.boundary_loops.front()) outline.push_back(u[i]);
    return outline;
}

Eigen::MatrixXd both_triangles(const Eigen::SparseMatrix<double>& lower) {
    const Eigen::MatrixXd dense(lower);
    return dense.selfadjointView<Eigen::Lower>();
}

}  // namespace

TEST_CASE("a half cylinder flattens without distortion to its true size") {
    const Surface s = patch(24, 10, [](double a, double b) {
        return Vector3d(0.2 * std::cos(M_PI * a), 0.2 * std::sin(M_PI * a), 0.5 * b);
    });
    const FlattenResult flat = flatten_disk(s);
    REQUIRE(flat.converged);
    CHECK(flat.stretch.max < 1e-6);
    CHECK(flat.stretch.within_5_percent == Approx(1));
    const double chord = 2 * 0.2 * std::sin(M_PI / 48);   // of one facet
    CHECK((flat.u[24] - flat.u[0]).norm() == Approx(24 * chord).epsilon(1e-6));
    CHECK((flat.u[25 * 10] - flat.u[0]).norm() == Approx(0.5).epsilon(1e-6));
}

namespace {

/// Least mean symmetric Dirichlet energy of a rotationally symmetric map t -> r(t) of a surface of revolution
/// with meridian length T and radius w(t): the one-dimensional functional, midpoint rule, minimised one
/// node at a time. Shares nothing with the code under test.
double least_energy_of_revolution(double T, const std::function<double(double)>& w) {
    const int n = 100;
    const double h = T / n;
    std::vector<double> r(n + 1);
    for (int i = 0; i <= n; ++i) r[i] = i * h;
    double weight = 0, sum = 0;
    const auto cell = [&](int i, double a, double b) {   // between nodes i and i+1
        const double radius = w((i + 0.5) * h), slope = (b - a) / h, hoop = (a + b) / 2 / radius;
        return (slope * slope + hoop * hoop + 1 / (slope * slope) + 1 / (hoop * hoop)) * radius * h;
    };
    for (int sweep = 0; sweep < 20000; ++sweep)
        for (int i = 1; i <= n; ++i) {
            const auto local = [&](double value) {
                return cell(i - 1, r[i - 1], value) + (i < n ? cell(i, value, r[i + 1]) : 0.0);
            };
            const double d = 1e-5 * h, g = (local(r[i] + d) - local(r[i] - d)) / (2 * d);
            const double k = (local(r[i] + d) - 2 * local(r[i]) + local(r[i] - d)) / (d * d);
            const double low = r[i - 1] + 1e-3 * h, high = i < n ? r[i + 1] - 1e-3 * h : 1e9;
            r[i] = std::clamp(r[i] - g / std::max(k, 1e-3), low, high);
        }
    for (int i = 0; i < n; ++i) sum += cell(i, r[i], r[i + 1]), weight += w((i + 0.5) * h) * h;
    return sum / weight;
}

}  // namespace

TEST_CASE("a hemisphere converges with the mesh to the least energy of its rotationally symmetric map") {
    const double oracle = least_energy_of_revolution(M_PI / 2, [](double t) { return std::sin(t); });
    CHECK(oracle == Approx(4.1413).margin(1e-3));   // what a converged SLIM reaches on a 4000-face hemisphere
    double error = 1;
    for (int rings : {16, 32, 64}) {
        const Surface s = cap(rings, 2 * rings, M_PI / 2);
        const FlattenResult flat = flatten_disk(s);
        REQUIRE(flat.converged);
        CHECK(flat.stretch.flips == 0);
        CHECK(outline_crossings(outline_of(s, flat.u)).empty());
        INFO(rings << " rings: " << flat.stretch.symmetric_dirichlet << ", oracle " << oracle);
        CHECK(std::abs(flat.stretch.symmetric_dirichlet - oracle) < error);
        error = std::abs(flat.stretch.symmetric_dirichlet - oracle) / 2;
    }
    CHECK(error < 1e-3);
}

TEST_CASE("a deep sock flattens without flips although its conformal map is extreme") {
    // A capsule, open at one end, four times as deep as wide: the worst disk that a bag can be.
    constexpr double depth = 9;
    const auto radius = [](double t) { return t < M_PI / 2 ? std::sin(t) : 1.0; };
    Surface s = cap(60, 40, 1.0);
    for (Vector3d& p : s.x) {
        const double t = std::acos(std::min(1.0, p.z())) * depth;   // distance from the pole along the meridian
        const double a = std::atan2(p.y(), p.x());
        p = Vector3d(radius(t) * std::cos(a), radius(t) * std::sin(a), t < M_PI / 2 ? -std::cos(t) : t - M_PI / 2);
    }
    for (auto& f : s.faces) std::swap(f[1], f[2]);
    const FlattenResult flat = flatten_disk(s);
    CHECK(flat.converged);
    CHECK(flat.stretch.flips == 0);
    CHECK(flat.stretch.symmetric_dirichlet < 1.02 * least_energy_of_revolution(depth, radius));
}

TEST_CASE("the fast flattening tells a good panel from a bad one as the converged one does") {
    for (double phi : {0.2, 0.5, 1.0, 1.5}) {
        const Surface s = cap(16, 32, phi);
        const StretchStatistics fast = flatten_disk(s, FlattenParams::fast()).stretch, exact = flatten_disk(s).stretch;
        CHECK(fast.mean == Approx(exact.mean).epsilon(0.1));
        CHECK(fast.max == Approx(exact.max).epsilon(0.2));
        CHECK(fast.flips == 0);
    }
}

TEST_CASE("flattening does not depend on where the disk stands, on its size or on its numbering") {
    const Surface s = cap(10, 20, 1.0);
    const double reference = flatten_disk(s).stretch.symmetric_dirichlet;
    Surface moved = s;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    for (Vector3d& p : moved.x) p = 1e-3 * (turn * p) + Vector3d(5, 6, 7);
    CHECK(flatten_disk(moved).stretch.symmetric_dirichlet == Approx(reference).epsilon(1e-6));
    Surface reversed = s;
    std::reverse(reversed.x.begin(), reversed.x.end());
    for (auto& t : reversed.faces)
        for (int& i : t) i = s.n_nodes() - 1 - i;
    std::reverse(reversed.faces.begin(), reversed.faces.end());
    CHECK(flatten_disk(reversed).stretch.symmetric_dirichlet == Approx(reference).epsilon(1e-6));
}

TEST_CASE("the isometry energy's gradient and projected Hessian agree with differences") {
    const Surface s = cap(3, 8, 1.2);
    const double peak = GENERATE(0.0, 3.0);
    const IsometryEnergy energy(s.faces, rest_shapes(s), s.n_nodes(), peak);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> jitter(-0.02, 0.02);
    VectorXd u(2 * s.n_nodes()), g, g2;
    for (int i = 0; i < s.n_nodes(); ++i)   // stretched, so that the Hessian is definite without projection
        u.segment<2>(2 * i) = 5 * s.x[i].head<2>() + Vector2d(jitter(random), jitter(random));
    Eigen::SparseMatrix<double> h, ignored;
    energy.assemble(u, 0, g, h);
    const Eigen::MatrixXd full = both_triangles(h);
    const double d = 1e-6;
    for (int i = 0; i < u.size(); ++i) {
        VectorXd plus = u, minus = u;
        plus[i] += d, minus[i] -= d;
        CHECK(g[i] == Approx((energy.value(plus) - energy.value(minus)) / (2 * d)).margin(1e-6 * (1 + peak * g.norm())));
        energy.assemble(plus, 0, g2, ignored);
        VectorXd column = g2;
        energy.assemble(minus, 0, g2, ignored);
        column = (column - g2) / (2 * d);
        CHECK((full.col(i) - column).norm() < 1e-5 * full.norm());
    }
    u *= 0.1;   // squeezed: the exact Hessian is indefinite, the projected one is not
    energy.assemble(u, 0, g, h);
    CHECK(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(both_triangles(h)).eigenvalues()[0] > -1e-8);
}

TEST_CASE("a strip that winds more than once overlaps itself when flat, and the outline says so") {
    const auto spiral = [](double turns) {
        return patch(60, 3, [turns](double a, double b) {
            const double angle = 2 * M_PI * turns * a, r = 1 + 0.2 * b;
            return Vector3d(r * std::cos(angle), -r * std::sin(angle), 0.5 * a);
        });
    };
    const Surface once = spiral(0.8), twice = spiral(1.4);
    CHECK(outline_crossings(outline_of(once, flatten_disk(once).u)).empty());
    CHECK_FALSE(outline_crossings(outline_of(twice, flatten_disk(twice).u)).empty());
}

TEST_CASE("flattening refuses what is no disk") {
    const Surface sphere = disk_meshes::icosphere(1);
    CHECK_THROWS_AS(flatten_disk(sphere), arcsim::InputError);
    Surface tube = cap(4, 12, 1.0);
    tube.faces.erase(tube.faces.begin(), tube.faces.begin() + 12);   // the fan around the pole
    CHECK_THROWS_WITH(flatten_disk(tube), Catch::Contains("2 boundary loops"));
    Surface flat = cap(3, 8, 0.5);
    flat.x[1] = flat.x[2];
    CHECK_THROWS_WITH(flatten_disk(flat), Catch::Contains("has no area"));
}
