#include <Eigen/Eigenvalues>
#include <random>

#include "arcsim/base/error.hpp"
#include "arcsim/force/strain_limit_element.hpp"
#include "arcsim/solve/cloth_stepper.hpp"
#include "arcsim/solve/limit_rounds.hpp"
#include "tests/arcsim/cloth_fixture.hpp"
#include "tests/check_derivatives.hpp"

using namespace arcsim;
using Catch::Contains;

namespace {

std::unique_ptr<StrainLimitForce> limits_of(const Patch& patch, double smallest, double largest) {
    std::vector<LimitedFace> faces;
    for (const StretchFace& f : patch.stretch_faces(0)) faces.push_back({static_cast<int>(faces.size()), f, smallest, largest});
    return std::make_unique<StrainLimitForce>(std::move(faces));
}

Matrix2d matrix(const Vector3d& T) {
    Matrix2d m;
    m << T[0], T[2], T[2], T[1];
    return m;
}

/// So soft that the limits have to do the work.
StretchingRows soft_rows() {
    StretchingRows r;
    r.fill({0.3, 0.002, 0.25, 0.0375});
    return r;
}

ClothModel limited_patch(const Patch& patch, const VectorXd& x, double smallest, double largest, const Vector3d& gravity = {0, 0, 0}) {
    ClothModel model = patch_model(patch, soft_rows(), x, gravity);
    model.limits = limits_of(patch, smallest, largest);
    return model;
}

StepParams converged_params(StepMethod method) {
    StepParams p;
    p.method = method;
    p.tolerance = 1e-9;
    return p;
}

Vector3d momentum(const ClothModel& model, const VectorXd& v) {
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < model.n_nodes(); ++i) sum += model.mass[i] * v.segment<3>(3 * i);
    return sum;
}

/// Flies apart: 40 % stretch per step of 0.01 s along x, turning.
State flying(const Patch& patch) {
    State s = patch.states().at("rest");
    for (int i = 0; i < s.x.size(); i += 3) {
        const Vector3d x = s.x.segment<3>(i);
        s.v.segment<3>(i) = Vector3d(40 * x.x() + 1, -10 * x.y(), 3 * x.x()) + Vector3d(1, 2, 15).cross(x);
    }
    return s;
}

}  // namespace

TEST_CASE("the positive part of a symmetric 2x2 matrix and its derivative are those of its eigenvalues") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1, 1);
    for (int trial = 0; trial < 200; ++trial) {
        const Vector3d T(number(random), number(random), number(random));
        Eigen::SelfAdjointEigenSolver<Matrix2d> eigen(matrix(T));
        const Matrix2d expected = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() * eigen.eigenvectors().transpose();
        const auto part = limit::positive_part_of(T);
        CHECK((matrix(part.value) - expected).norm() <= 1e-14);
        for (int c = 0; c < 3; ++c) {
            const Vector3d step = 1e-6 * Vector3d::Unit(c);
            const Vector3d difference = (limit::positive_part_of(T + step).value - limit::positive_part_of(T - step).value) / 2e-6;
            CHECK((part.derivative.col(c) - difference).norm() <= 1e-5);
        }
    }
    CHECK(limit::positive_part_of({2, 2, 0}).value == Vector3d(2, 2, 0));     // equal eigenvalues
    CHECK(limit::positive_part_of({-2, -2, 0}).value == Vector3d(0, 0, 0));
}

TEST_CASE("the strain limits' force is the derivative of its energy in every state, with and without multipliers") {
    const Patch patch;
    for (const auto& [name, state] : patch.states()) {
        const auto limits = limits_of(patch, 0.97, 1.02);
        limits->set_penalty(3000);
        INFO(name);
        check_derivatives(*limits, state, patch.faces, {.step = 1e-8, .tolerance = 1e-4});
        check_invariants(*limits, state);
        limits->update(patch.states().at("stretched").x);
        limits->set_penalty(500);
        check_derivatives(*limits, state, patch.faces, {.step = 1e-8, .tolerance = 1e-4});
        check_invariants(*limits, state);
    }
}

TEST_CASE("a step ends inside the strain limits, in balance with what they carry, and keeps its momentum") {
    const Patch patch;
    for (const StepMethod method : {StepMethod::backward_euler, StepMethod::newton_euler, StepMethod::bdf2})
        for (const auto& [smallest, largest] : {std::pair(0.0, 1.03), std::pair(0.98, 1.01)}) {
            State s = flying(patch);
            ClothModel model = limited_patch(patch, s.x, smallest, largest);
            const auto stepper = make_stepper(model, converged_params(method));
            const Vector3d before = momentum(model, s.v);
            for (int step = 1; step <= 5; ++step) {
                s.time = 0.01 * step;
                stepper->step(s, 0.01);
                INFO("method " << static_cast<int>(method) << " limits " << smallest << " " << largest << " step " << step);
                CHECK(model.limits->worst(s.x).beyond <= 2 * LimitRounds::tolerance);
                if (step == 1) CHECK_FALSE(model.limits->is_idle(s.x));
                CHECK((momentum(model, s.v) - before).norm() <= 1e-9 * before.norm());
            }
        }
}

TEST_CASE("a converged step inside strain limits solves its balance with multipliers that push only at the bounds") {
    const Patch patch;
    State s = flying(patch);
    s.v *= 0.25;
    ClothModel model = limited_patch(patch, s.x, 0.98, 1.01, {0, 0, -9.81});
    const auto stepper = make_stepper(model, converged_params(StepMethod::newton_euler));
    const State start = s;
    const double h = s.time = 0.01;
    REQUIRE(stepper->step(s, h).halvings == 0);
    VectorXd r = VectorXd::Zero(s.x.size()), limit_force = r;
    model.refresh(s.x);
    model.limits->set_penalty(1e-9);   // the force is that of the multipliers alone
    for (const Force* f : std::initializer_list<const Force*>{model.stretch.get(), model.bend.get(), model.gravity.get(), model.limits.get()})
        f->add_gradient(s, r);
    model.limits->add_gradient(s, limit_force);
    for (int i = 0; i < s.x.size(); ++i) r[i] = r[i] + model.mass[i / 3] * (s.v[i] - start.v[i]) / h;
    CHECK(limit_force.norm() > 1e-4);
    CHECK(r.norm() <= 1e-6 * limit_force.norm());
    // Multipliers: no negative eigenvalue, and no work against what a face has left to its bounds.
    const std::vector<double> m = model.limits->multipliers();
    for (std::size_t f = 0; f < patch.faces.size(); ++f) {
        const Vector3d G = model.stretch->strain(s.x, static_cast<int>(f));
        for (const auto& [offset, bound, sign] : {std::tuple(0, 0.5 * (1.01 * 1.01 - 1), 1.0), std::tuple(3, 0.5 * (0.98 * 0.98 - 1), -1.0)}) {
            const Matrix2d lambda = matrix({m[6 * f + offset], m[6 * f + offset + 1], m[6 * f + offset + 2]});
            const Matrix2d left = sign * (bound * Matrix2d::Identity() - matrix(G));
            const Eigen::SelfAdjointEigenSolver<Matrix2d> carried(lambda), slack(left);
            CHECK(carried.eigenvalues()[0] >= -1e-9 * (1 + lambda.norm()));
            CHECK(slack.eigenvalues()[0] >= -2 * LimitRounds::tolerance);
            CHECK(std::abs((lambda * left).trace()) <= 5 * LimitRounds::tolerance * lambda.norm());
        }
    }
}

TEST_CASE("what strain limits carry does not turn the cloth") {
    const Patch patch;
    const State start = flying(patch);
    ClothModel model = limited_patch(patch, start.x, 0, 1.01);
    State s = start;
    s.time = 0.01;
    make_stepper(model, converged_params(StepMethod::newton_euler))->step(s, 0.01);
    Vector3d torque = Vector3d::Zero(), size = torque;   // of the impulses m (v1 - v0), at x1
    for (int i = 0; i < model.n_nodes(); ++i) {
        const Vector3d turned = model.mass[i] * s.x.segment<3>(3 * i).cross((s.v - start.v).segment<3>(3 * i));
        torque += turned;
        size += turned.cwiseAbs();
    }
    CHECK(size.norm() > 1e-7);
    CHECK(torque.norm() <= 1e-6 * size.norm());
}

TEST_CASE("limits that nothing reaches change no digit, and without limits there is no such force") {
    const Patch patch;
    for (const StepMethod method : {StepMethod::backward_euler, StepMethod::newton_euler}) {
        State limited = patch.states().at("bent"), plain = limited;
        ClothModel with = limited_patch(patch, limited.x, 0.1, 5, {0, 0, -9.81}), without = patch_model(patch, soft_rows(), plain.x, {0, 0, -9.81});
        REQUIRE_FALSE(without.limits);
        make_stepper(with, converged_params(method))->step(limited, 1e-3);
        make_stepper(without, converged_params(method))->step(plain, 1e-3);
        CHECK(limited.x == plain.x);
    }
}

TEST_CASE("limits that held nodes pull apart are named, with the face and its stretch") {
    const Patch patch;
    for (const StepMethod method : {StepMethod::backward_euler, StepMethod::newton_euler}) {
        State s = patch.states().at("rest");
        ClothModel model = limited_patch(patch, s.x, 0, 1.05);
        for (int k = 0; k < 4; ++k) model.held.push_back({k, s.x.segment<3>(3 * k)});
        for (int k = 12; k < 16; ++k) model.held.push_back({k, s.x.segment<3>(3 * k) + Vector3d(0, 0.005, 0)});
        StepParams p = converged_params(method);
        p.max_halvings = 1;
        const State before = s;
        CHECK_THROWS_WITH(make_stepper(model, p)->step(s, 0.01), Contains("strain limits cannot be met: face") && Contains("beyond its limit"));
        CHECK(s.x == before.x);
        CHECK(s.v == before.v);
    }
}
