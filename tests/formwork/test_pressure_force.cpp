#include <catch2/catch.hpp>

#include "check_force.hpp"
#include "formwork/load/pressure_force.hpp"
#include "formwork/load/wet_part.hpp"
#include "shapes.hpp"

using namespace formwork;

namespace {

constexpr double rho_g = 14715;
const Vector3d up(0, 0, 1);

PressureForce load_on(const shapes::Bag& bag, PressureQuadrature q = PressureQuadrature::consistent,
                      double overpressure = 0) {
    return {bag.surface.faces, up, rho_g, overpressure, q, PressureJacobian::consistent};
}

State state_of(const shapes::Bag& bag) {
    State s;
    s.x = shapes::flatten(bag.surface.x);
    return s;
}

Vector3d total(const VectorXd& g) {
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < g.size() / 3; ++i) sum -= g.segment<3>(3 * i);
    return sum;
}

}  // namespace

TEST_CASE("the integrals over the wet part of a triangle are exact") {
    // against a fine subdivision of the triangle
    for (const Vector3d& q : {Vector3d(1, -0.5, -2), Vector3d(0.7, 0.2, -0.3), Vector3d(-1, 2, -1e-3), Vector3d(1, 1, 1),
                              Vector3d(-1, -1, -1), Vector3d(0, 1, -1)}) {
        arcsim::Matrix3d sum = arcsim::Matrix3d::Zero();
        constexpr int n = 400;
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j)
                for (int half = 0; half < (i + j + 1 < n ? 2 : 1); ++half) {
                    const double o = half ? 2. / 3 : 1. / 3;
                    const Vector3d phi((i + o) / n, (j + o) / n, 1 - (i + j + 2 * o) / n);
                    if (phi.dot(q) > 0) sum += phi * phi.transpose() / (n * n);
                }
        REQUIRE((wet_part(q) - sum).norm() < 3e-3);
        REQUIRE((wet_part(q) - wet_part(q).transpose()).norm() < 1e-16);
    }
}

TEST_CASE("the total load is the liquid's weight, to rounding, and pushes downward whatever the orientation") {
    for (const double level : {0.0, -0.07, -0.15, 0.03})
        for (const bool flipped : {false, true}) {
            shapes::Bag bag = shapes::sock(0.1, 0.2, 5);
            shapes::jiggle(bag.surface.x, bag.held, 0.004, 1);
            if (flipped)
                for (auto& f : bag.surface.faces) std::swap(f[1], f[2]);
            PressureForce load = load_on(bag);
            const State s = state_of(bag);
            load.set_level(level);
            load.set_orientation(liquid_orientation(bag.surface.faces, s.x, up, level));
            REQUIRE(load.orientation() == (flipped ? -1 : 1));
            VectorXd g = VectorXd::Zero(s.x.size());
            load.add_gradient(s, g);
            const LiquidTotals liquid = load.totals(s.x, level);
            const Vector3d F = total(g);
            INFO("level " << level);
            REQUIRE(liquid.volume > 0);
            REQUIRE(F[2] == Approx(-rho_g * liquid.volume).epsilon(1e-13));
            // the rim is plane and horizontal; with a head over it the open rim takes its part of the sideways load
            REQUIRE(std::hypot(F[0], F[1]) < 1e-12 * std::abs(F[2]));
            const double d = 1e-6;
            REQUIRE(liquid.waterplane == Approx((load.totals(s.x, level + d).volume -
                                                 load.totals(s.x, level - d).volume) / (2 * d)).epsilon(1e-6));
            VectorXd b, up_g = VectorXd::Zero(s.x.size()), down_g = up_g;
            load.level_derivative(s.x, b);
            load.set_level(level + d);
            load.add_gradient(s, up_g);
            load.set_level(level - d);
            load.add_gradient(s, down_g);
            REQUIRE((b + (up_g - down_g) / (2 * d)).norm() < 1e-5 * b.norm());
            load.set_level(level);
            REQUIRE(level_of_volume(load, s.x, liquid.volume, -0.1) == Approx(level).margin(1e-12));
        }
}

TEST_CASE("uniform pressure in a closed shape has no resultant, and its virial is three times p V") {
    shapes::Bag bag = shapes::hemisphere(0.1, 6);
    const int rim = bag.surface.n_nodes() - 36;            // close it by a fan
    const int top = bag.surface.n_nodes();
    bag.surface.x.push_back({0.01, 0, 0.03});
    for (int j = 0; j < 36; ++j) bag.surface.faces.push_back({rim + j, rim + (j + 1) % 36, top});
    PressureForce load(bag.surface.faces, up, 0, 200, PressureQuadrature::consistent, PressureJacobian::consistent);
    const State s = state_of(bag);
    VectorXd g = VectorXd::Zero(s.x.size());
    load.add_gradient(s, g);
    double volume = 0;
    for (const auto& t : bag.surface.faces)
        volume += bag.surface.x[t[0]].dot(bag.surface.x[t[1]].cross(bag.surface.x[t[2]])) / 6;
    REQUIRE(volume > 0);
    REQUIRE(total(g).norm() < 1e-13 * g.lpNorm<1>());
    REQUIRE(-g.dot(s.x) == Approx(3 * 200 * volume).epsilon(1e-12));
    REQUIRE(liquid_orientation(bag.surface.faces, s.x, up, -5.0) == 1);
}

TEST_CASE("pressure tangents are the derivative of the load, and symmetric where the rim is held") {
    for (const PressureQuadrature quadrature : {PressureQuadrature::consistent, PressureQuadrature::lumped})
        for (const double level : {0.02, -0.04}) {
            shapes::Bag bag = shapes::hemisphere(0.1, 4);
            shapes::jiggle(bag.surface.x, {}, 0.004, 3);
            PressureForce load = load_on(bag, quadrature, 150);
            load.set_level(level);
            const State s = state_of(bag);
            const DerivativeErrors e = check_derivatives(load, bag.surface.faces, s, 1e-7);
            INFO("level " << level << (quadrature == PressureQuadrature::lumped ? " lumped" : " consistent"));
            REQUIRE(e.hessian < 1e-7);
            if (quadrature == PressureQuadrature::lumped) continue;
            const arcsim::BlockPattern pattern(bag.surface.n_nodes(), bag.surface.faces);
            load.bind(pattern);
            arcsim::BlockMatrix H(pattern, arcsim::BlockMatrix::Kind::general);
            load.add_hessian(s, Tangent::exact, H);
            REQUIRE(e.asymmetry > 1e-3);                                  // with the rim's rows
            H.fix(arcsim::FixedDofs(pattern, bag.held));
            const arcsim::MatrixXd K = H.dense();
            REQUIRE((K - K.transpose()).norm() < 1e-14 * K.norm());       // without
        }
}

TEST_CASE("the hydrostatic load has a potential") {
    shapes::Bag bag = shapes::hemisphere(0.1, 4);
    for (const double level : {0.0, -0.04}) {
        PressureForce load = load_on(bag, PressureQuadrature::consistent, 100);
        load.set_level(level);
        State s = state_of(bag);
        VectorXd g = VectorXd::Zero(s.x.size());
        load.add_gradient(s, g);
        std::vector<Vector3d> motion(bag.surface.x.size(), Vector3d::Zero());
        shapes::jiggle(motion, bag.held, 1, 4);                           // the held rim stays
        const VectorXd d = shapes::flatten(motion);
        State a = s, b = s;
        a.x += 1e-6 * d;
        b.x -= 1e-6 * d;
        REQUIRE((*load.energy(a) - *load.energy(b)) / 2e-6 == Approx(g.dot(d)).epsilon(1e-8));
    }
}

TEST_CASE("(9)'s tangent keeps the pressure's change alone") {
    shapes::Bag bag = shapes::hemisphere(0.1, 3);
    PressureForce load(bag.surface.faces, up, rho_g, 0, PressureQuadrature::lumped, PressureJacobian::lumped);
    load.set_level(0.05);
    const State s = state_of(bag);
    const arcsim::BlockPattern pattern(bag.surface.n_nodes(), bag.surface.faces);
    load.bind(pattern);
    arcsim::BlockMatrix H(pattern, arcsim::BlockMatrix::Kind::general);
    load.add_hessian(s, Tangent::exact, H);
    VectorXd g = VectorXd::Zero(s.x.size());
    load.add_gradient(s, g);
    const arcsim::MatrixXd K = H.dense();
    for (int i = 0; i < bag.surface.n_nodes(); ++i) {                     // f = A p n, so -df/dx = A rho g n d^T = f d^T / q
        const double q = 0.05 - s.x[3 * i + 2];
        const arcsim::Matrix3d expected = Vector3d(-g.segment<3>(3 * i)) * up.transpose() / q;
        REQUIRE((K.block<3, 3>(3 * i, 3 * i) - expected).norm() < 1e-12 * expected.norm());
    }
}

TEST_CASE("the lumped load has the consistent one's total and approaches it node by node") {
    double previous = 0;
    for (int n : {4, 8, 16}) {
        shapes::Bag bag = shapes::disk(0.1, n);
        for (auto& p : bag.surface.x) p[2] = 4 * (p[0] * p[0] + p[1] * p[1] - 0.01);
        const State s = state_of(bag);
        VectorXd a = VectorXd::Zero(s.x.size()), b = a;
        PressureForce lumped = load_on(bag, PressureQuadrature::lumped), consistent = load_on(bag);
        lumped.add_gradient(s, a);
        consistent.add_gradient(s, b);
        REQUIRE(total(a)[2] == Approx(total(b)[2]).epsilon(1e-13));
        const double error = (a - b).norm() / b.norm();                   // order 1.5: the rim dominates
        if (previous > 0) REQUIRE(std::log2(previous / error) == Approx(1.5).margin(0.4));
        previous = error;
    }
}
