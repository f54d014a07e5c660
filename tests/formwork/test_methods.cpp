#include <catch2/catch.hpp>

#include "formwork/equilibrium/dynamic_relaxation.hpp"
#include "formwork/equilibrium/time_step.hpp"
#include "filled_bag.hpp"

using namespace formwork;
using arcsim::MatrixXd;

namespace {

EquilibriumProblem filled(const shapes::Bag& bag, double level, SolverMethod method = SolverMethod::static_newton) {
    EquilibriumProblem p = filled_bag(bag, level);
    p.self_weight = true;
    p.fabric_density = 0.2;
    p.solver.method = method;
    return p;
}

/// A shallow dish, taut everywhere, with a smooth velocity: what the steps are checked on.
struct Dish {
    EquilibriumProblem problem;
    Motion motion;

    explicit Dish(int rings) : problem(filled(shapes::disk(0.15, rings), 0)) {
        problem.material.law = IsotropicLaw::separable;
        problem.material.compression = Compression::full;
        const Eigen::Index n = problem.rest.n_nodes();
        motion.x.resize(3 * n);
        motion.v = VectorXd::Zero(3 * n);
        for (Eigen::Index i = 0; i < n; ++i) {
            const Vector3d& X = problem.rest.x[i];
            const double bump = 1 - X.head<2>().squaredNorm() / (0.15 * 0.15);
            motion.x.segment<3>(3 * i) = Vector3d(X[0] * (1 + 0.05 * bump), X[1], -0.05 * bump * (1 + X[0] + 3 * X[1]));
            if (bump > 1e-9) motion.v.segment<3>(3 * i) = bump * Vector3d(0.1, -0.2, 0.3 + X[0]);
        }
    }
};

/// -dg/dx by central differences.
template <class Gradient>
MatrixXd jacobian(const VectorXd& x, const Gradient& gradient) {
    const double h = 1e-6;
    MatrixXd J(x.size(), x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
        arcsim::State a, b;
        a.x = b.x = x;
        a.x[k] += h;
        b.x[k] -= h;
        VectorXd ga = VectorXd::Zero(x.size()), gb = ga;
        gradient(a, ga);
        gradient(b, gb);
        J.col(k) = -(ga - gb) / (2 * h);
    }
    return J;
}

}  // namespace

TEST_CASE("every method ends in the same shape") {
    const auto method = GENERATE(SolverMethod::backward_euler, SolverMethod::newton_euler, SolverMethod::bdf2,
                                 SolverMethod::dynamic_relaxation, SolverMethod::projective);
    INFO(arcsim::name_of(solver_method_names, method));
    SECTION("a disk filled to its rim, all taut, from flat") {
        EquilibriumProblem p = filled(shapes::disk(0.15, 5), 0);
        if (method == SolverMethod::bdf2) p.solver.damping = 0.01;   // nothing else brings its swing to rest
        const EquilibriumResult expected = find_equilibrium(p);
        p.solver.method = method;
        const EquilibriumResult r = find_equilibrium(p);
        CHECK(r.residual <= 1e-8);
        CHECK(r.method == arcsim::name_of(solver_method_names, method));
        CHECK(largest_difference(r, expected) < 1e-7);
    }
    SECTION("a square that wrinkles, its volume prescribed") {
        EquilibriumProblem p = filled(shapes::square(0.3, 10), 0);
        p.plaster.fill->level.reset();
        p.plaster.fill->volume = 0.006;
        p.solver.tolerance = 1e-6;
        p.solver.max_iterations = 1000;
        if (method == SolverMethod::bdf2) p.solver.damping = 0.01;
        const EquilibriumResult expected = find_equilibrium(p);
        CHECK(expected.wrinkled_faces > 0);
        p.solver.method = method;
        const EquilibriumResult r = find_equilibrium(p);
        CHECK(r.residual <= 1e-6);
        CHECK(r.depth_m == Approx(expected.depth_m).epsilon(1e-4));
        CHECK(r.fill_level_m == Approx(expected.fill_level_m).margin(1e-5));
    }
}

TEST_CASE("the step of backward Euler solves A dv = b as the source has it, damping on the fabric alone") {
    const Dish dish(2);
    for (const LinearSolverChoice solver : {LinearSolverChoice::cholmod, LinearSolverChoice::umfpack}) {
        EquilibriumProblem p = dish.problem;
        p.solver.linear_solver = solver;
        StaticSystem system(p);
        StepMatrix matrix(system, p);
        Motion now = dish.motion, next;
        now.balance = system.gradient(now.x, now.g);
        const double h = 0.002, beta = 0.003;
        std::string why;
        LinearisedEuler step(matrix, beta);
        REQUIRE(step.take(now, h, 0, next, why));

        const MatrixXd J_fabric = jacobian(now.x, [&](const State& s, VectorXd& g) { system.membrane().add_gradient(s, g); });
        const MatrixXd J_other = jacobian(now.x, [&](const State& s, VectorXd& g) { system.pressure().add_gradient(s, g); });
        MatrixXd A = MatrixXd(matrix.mass().asDiagonal()) - h * (h + beta) * J_fabric - h * h * J_other;
        VectorXd b = -h * now.g + h * (h + beta) * J_fabric * now.v + h * h * J_other * now.v;
        for (const int d : system.fixed().list()) {
            A.row(d).setZero();
            A.col(d).setZero();
            A(d, d) = 1;
            b[d] = 0;
        }
        const VectorXd dv = A.partialPivLu().solve(b);
        CHECK((next.v - now.v - dv).lpNorm<Eigen::Infinity>() < 1e-6 * dv.lpNorm<Eigen::Infinity>());
        CHECK((next.x - now.x - h * next.v).isZero(1e-15));
    }
}

TEST_CASE("backward Euler is of first order in time, BDF2 of second") {
    const Dish dish(3);
    StaticSystem system(dish.problem);
    StepMatrix matrix(system, dish.problem);
    const auto at_rest_of = [&](TimeStep& step, int n_steps) {
        Motion now = dish.motion, next;
        step.restart();
        std::string why;
        for (int k = 0; k < n_steps; ++k) {
            now.balance = system.gradient(now.x, now.g);
            INFO(why);
            REQUIRE(step.take(now, 0.001 / n_steps, 1e-12, next, why));
            std::swap(now, next);
        }
        return now.x;
    };
    LinearisedEuler linearised(matrix, 0);
    ConvergedStep euler(system, matrix, 0, false, 1e-10), bdf2(system, matrix, 0, true, 1e-10);
    const VectorXd reference = at_rest_of(bdf2, 1024);
    const auto order = [&](TimeStep& step) {
        const double coarse = (at_rest_of(step, 32) - reference).norm(), fine = (at_rest_of(step, 64) - reference).norm();
        return std::log2(coarse / fine);
    };
    CHECK(order(linearised) == Approx(1).margin(0.1));
    CHECK(order(euler) == Approx(1).margin(0.1));
    CHECK(order(bdf2) == Approx(2).margin(0.15));
}

TEST_CASE("a method in time that does not come to rest says so and keeps its last state") {
    EquilibriumProblem p = filled(shapes::disk(0.15, 4), 0, SolverMethod::backward_euler);
    p.solver.end_time = 0.03;
    try {
        find_equilibrium(p);
        FAIL("found an equilibrium");
    } catch (const EquilibriumError& e) {
        CHECK_THAT(e.what(), Catch::Contains("not at rest after 3 steps") && Catch::Contains("end_time"));
        CHECK_FALSE(e.last->converged);
        CHECK(e.last->x.size() == p.rest.x.size());
    }
    p.fabric_density = 0;
    CHECK_THROWS_WITH(find_equilibrium(p), Catch::Contains("fabric with mass"));
}

TEST_CASE("ballooning ends every method with its name") {
    const auto method = GENERATE(SolverMethod::backward_euler, SolverMethod::newton_euler, SolverMethod::bdf2,
                                 SolverMethod::dynamic_relaxation, SolverMethod::projective);
    INFO(arcsim::name_of(solver_method_names, method));
    EquilibriumProblem p = filled(shapes::disk(0.45, 5), 0, method);
    p.material.max = p.material.rest;
    CHECK_THROWS_WITH(find_equilibrium(p), Catch::Contains("ballooning"));
}

TEST_CASE("row sums for the masses of dynamic relaxation are those of the whole matrix") {
    const Dish dish(2);
    StaticSystem system(dish.problem);
    BlockMatrix H(system.pattern());
    VectorXd border;
    system.tangent(dish.motion.x, 1, H, border, arcsim::Tangent::exact);
    CHECK(absolute_row_sums(H).isApprox(H.dense().cwiseAbs().rowwise().sum(), 1e-13));
}
