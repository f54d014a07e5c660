#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "arcsim/base/error.hpp"
#include "arcsim/solve/converged_stepper.hpp"
#include "arcsim/solve/start_relaxation.hpp"
#include "tests/arcsim/cloth_fixture.hpp"

using namespace arcsim;
using Catch::Contains;

namespace {

StepParams params_of(StepMethod method) {
    StepParams p;
    p.method = method;
    p.tolerance = 1e-9;
    return p;
}
const auto all_methods = {StepMethod::backward_euler, StepMethod::newton_euler, StepMethod::bdf2};

/// A stretched and turning patch, let go: its state after `time` in `n` steps.
State let_go(StepMethod method, int n, double time, double damping = 0) {
    const Patch patch;
    State s = patch.states().at("rest");
    for (int i = 0; i < s.x.size(); i += 3) {
        const Vector3d x = s.x.segment<3>(i);
        s.v.segment<3>(i) = Vector3d(20 * x.x(), 5 * x.y(), 0) + Vector3d(1, 2, 30).cross(x);
    }
    ClothModel model = patch_model(patch, constant_rows(), s.x, {0, 0, 0}, damping);
    const auto stepper = make_stepper(model, params_of(method));
    for (int i = 0; i < n; ++i) {
        s.time = time * (i + 1) / n;
        stepper->step(s, time / n);
    }
    return s;
}

double order_of(StepMethod method, double damping) {
    const double time = 1e-3;   // s; a swing of the stretch
    const State exact = let_go(StepMethod::bdf2, 2048, time, damping);
    const double coarse = (let_go(method, 128, time, damping).x - exact.x).norm();
    const double fine = (let_go(method, 256, time, damping).x - exact.x).norm();
    return std::log2(coarse / fine);
}

}  // namespace

TEST_CASE("backward Euler converges with order 1, BDF2 with order 2") {
    CHECK(order_of(StepMethod::newton_euler, 0) == Approx(1).margin(0.15));
    CHECK(order_of(StepMethod::backward_euler, 0) == Approx(1).margin(0.15));
    CHECK(order_of(StepMethod::bdf2, 0) == Approx(2).margin(0.25));
    CHECK(order_of(StepMethod::bdf2, 1e-4) == Approx(2).margin(0.25));
}

TEST_CASE("the linearised step solves (M + h (h + beta) H) dv = h f - h (h + beta) H v") {
    const Patch patch;
    State s = patch.states().at("stretched");
    s.v = VectorXd::LinSpaced(s.x.size(), -1, 1);
    const double h = 0.003, beta = 0.01;
    ClothModel model = patch_model(patch, woven_rows(), s.x, {0, 0, -9.81}, beta);
    const auto stepper = make_stepper(model, params_of(StepMethod::backward_euler));
    BlockMatrix H(stepper->system().pattern());
    VectorXd g = VectorXd::Zero(s.x.size());
    model.stretch->add_gradient_and_hessian(s, Tangent::definite, g, H);
    model.bend->add_gradient_and_hessian(s, Tangent::definite, g, H);
    model.gravity->add_gradient(s, g);
    MatrixXd A = h * (h + beta) * H.dense();
    const VectorXd b = -h * g - A * s.v;
    for (int i = 0; i < s.x.size(); ++i) A(i, i) += model.mass[i / 3];
    const VectorXd v = s.v + A.llt().solve(b), x = s.x + h * v;
    s.time = h;
    stepper->step(s, h);
    CHECK((s.v - v).norm() <= 1e-8 * v.norm());
    CHECK((s.x - x).norm() <= 1e-8 * x.norm());
}

TEST_CASE("a free patch keeps its momentum and falls with gravity") {
    for (const StepMethod method : all_methods) {
        const Patch patch;
        State s = patch.states().at("bent");
        ClothModel model = patch_model(patch, constant_rows(), s.x, {0, 0, -9.81});
        const auto stepper = make_stepper(model, params_of(method));
        const int n = 20;
        const double h = 1e-3;
        for (int i = 0; i < n; ++i) {
            s.time = h * (i + 1);
            stepper->step(s, h);
        }
        Vector3d momentum = Vector3d::Zero();
        for (int i = 0; i < model.n_nodes(); ++i) momentum += model.mass[i] * s.v.segment<3>(3 * i);
        INFO("method " << static_cast<int>(method));
        CHECK((momentum / model.mass.sum() - Vector3d(0, 0, -9.81 * n * h)).norm() <= 1e-6);
    }
}

TEST_CASE("hard handles stand exactly where they are told") {
    for (const StepMethod method : all_methods) {
        const Patch patch;
        State s = patch.states().at("rest");
        ClothModel model = patch_model(patch, woven_rows(), s.x, {0, 0, -9.81});
        const Vector3d corner = s.x.segment<3>(0), moved = s.x.segment<3>(9) + Vector3d(0.001, 0, 0.0005);
        model.held = {{0, corner}, {3, moved}};
        const auto stepper = make_stepper(model, params_of(method));
        s.time = 0.01;
        stepper->step(s, 0.01);
        CHECK((s.x.segment<3>(0) - corner).norm() <= 1e-16);
        CHECK((s.x.segment<3>(9) - moved).norm() <= 1e-16);
    }
}

TEST_CASE("wind, springs and glue act in a converged step as in its balance") {
    const Patch patch;
    State s = patch.states().at("stretched");
    ClothModel model = patch_model(patch, constant_rows(), s.x, {0, 0, -9.81}, 1e-3, 1.2);
    model.springs.reserve_pairs({{12, 15}});
    model.springs.set({{0, 1e3, s.x.segment<3>(0)}, {3, 1e3, s.x.segment<3>(9)}}, {{12, 15, 0.1}});
    const auto stepper = make_stepper(model, params_of(StepMethod::newton_euler));
    const State before = s;
    const double h = 1e-4;
    s.time = h;
    REQUIRE(stepper->step(s, h).halvings == 0);
    // M (v - v0) + h (g + D v) = 0 with everything taken at the new state.
    model.refresh(s.x);
    VectorXd r = VectorXd::Zero(s.x.size());
    for (const Force* f : std::initializer_list<const Force*>{model.stretch.get(), model.bend.get(), model.gravity.get(),
                                                              model.wind.get(), &model.springs})
        f->add_gradient(s, r);
    BlockMatrix D(stepper->system().pattern());
    model.stretch->add_damping(s, D);
    model.bend->add_damping(s, D);
    r += D.dense() * s.v;
    const double largest_force = r.cwiseAbs().maxCoeff();
    r *= h;
    for (int i = 0; i < s.x.size(); ++i) r[i] += model.mass[i / 3] * (s.v[i] - before.v[i]);
    CHECK(r.cwiseAbs().maxCoeff() <= 1e-7 * h * largest_force);
}

TEST_CASE("a step that fails is halved, and one that cannot succeed leaves the state as it was") {
    const Patch patch;
    State s = patch.states().at("rest");
    // The lower edge is jerked to a quarter of the patch in one step: it has to buckle.
    for (int i = 0; i < s.x.size(); i += 3) s.x[i + 2] = 1e-5 * std::sin(700 * s.x[i + 1]);
    ClothModel model = patch_model(patch, woven_rows(), s.x);
    for (int k = 0; k < 4; ++k) model.held.push_back({k, s.x.segment<3>(3 * k)});
    for (int k = 12; k < 16; ++k) {
        Vector3d goal = s.x.segment<3>(3 * k);
        goal.y() = 0.25 * goal.y();
        model.held.push_back({k, goal});
    }
    StepParams p = params_of(StepMethod::newton_euler);
    p.max_halvings = 0;
    p.max_iterations = 2;
    const State before = s;
    s.time = 1;
    const auto strict = make_stepper(model, p);
    CHECK_THROWS_WITH(strict->step(s, 1.0), Contains("worst face"));
    CHECK(s.x == before.x);
    CHECK(s.v == before.v);

    // A stretch beyond the limit is a failure too.
    model.held.back().target += Vector3d(0.5, 0, 0);
    p = params_of(StepMethod::newton_euler);
    p.max_stretch = 1.5;
    p.max_halvings = 3;
    s.time = 1;
    CHECK_THROWS_WITH(make_stepper(model, p)->step(s, 1.0), Contains("is stretched") || Contains("worst face"));
    CHECK(s.x == before.x);
}

TEST_CASE("a sheet that is pressed together in one step buckles in parts of it, and stays whole") {
    for (const StepMethod method : {StepMethod::newton_euler, StepMethod::bdf2}) {
        const Patch patch;
        State s = patch.states().at("rest");
        for (int i = 0; i < s.x.size(); i += 3) s.x[i + 2] = 1e-5 * std::sin(700 * s.x[i + 1]);
        ClothModel model = patch_model(patch, woven_rows(), s.x);
        const VectorXd start = s.x;
        const auto stepper = make_stepper(model, params_of(method));
        int parts = 0;
        stepper->place_handles = [&](double time) {   // the upper edge moves down, in the plane
            ++parts;
            model.held.clear();
            for (int k : {0, 1, 2, 3, 12, 13, 14, 15}) {
                Vector3d goal = start.segment<3>(3 * k);
                if (k >= 12) goal.y() *= 1 - 0.3 * time;
                model.held.push_back({k, goal});
            }
        };
        s.time = 1;
        const StepResult result = stepper->step(s, 1.0);
        INFO("method " << static_cast<int>(method) << ", parts " << parts << ", halvings " << result.halvings);
        CHECK(result.halvings > 0);
        CHECK(parts > result.halvings);
        CHECK(s.time == 1);
        CHECK(s.x[3 * 12 + 1] == 0.7 * start[3 * 12 + 1]);
        CHECK(model.stretch->largest_stretch(s.x).second < 7.0 / 6);   // inside the table
        double height = 0;
        for (int i = 2; i < s.x.size(); i += 3) height = std::max(height, std::abs(s.x[i]));
        CHECK(height > 1e-3);
    }
}

TEST_CASE("numbers that are not finite are found, never stored") {
    for (const StepMethod method : all_methods) {
        const Patch patch;
        State s = patch.states().at("bent");
        ClothModel model = patch_model(patch, constant_rows(), s.x);
        const auto stepper = make_stepper(model, params_of(method));
        s.v[5] = std::nan("");
        s.time = 0.01;
        CHECK_THROWS_AS(stepper->step(s, 0.01), NumericalError);
        CHECK(s.x == patch.states().at("bent").x);
    }
}

TEST_CASE("the start relaxation leaves a flat sheet as read and takes the stretch out of another") {
    const Patch patch;
    for (const auto& [name, moves] : {std::pair("rest", false), std::pair("stretched", true)}) {
        State s = patch.states().at(name);
        const VectorXd start = s.x;
        ClothModel model = patch_model(patch, woven_rows(), s.x);
        ClothSystem system(model);
        const int steps = relax_start(system, s.x);
        CHECK((steps > 0) == moves);
        CHECK((s.x == start) == !moves);
        if (moves) {
            State relaxed{s.x, s.v, 0}, read{start, s.v, 0};
            CHECK(model.stretch->frozen_energy(relaxed) < 0.01 * model.stretch->frozen_energy(read));
        }
    }
}
