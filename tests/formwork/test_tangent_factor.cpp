#include <catch2/catch.hpp>

#include "arcsim/solve/own_factor.hpp"
#include "arcsim/solve/pcg.hpp"
#include "filled_bag.hpp"
#include "formwork/equilibrium/static_system.hpp"
#include "formwork/equilibrium/tangent_factor.hpp"

using namespace formwork;

namespace {

struct Tangents {
    EquilibriumProblem problem = filled_bag(shapes::sock(0.1, 0.15, 6), 0);
    StaticSystem system{problem};
    arcsim::BlockMatrix H{system.pattern()};
    arcsim::VectorXd border;

    /// At rest with T0 times the Laplacian; a negative one makes the matrix indefinite.
    void make(double T0) {
        system.tangent(flatten(problem.rest.x), 0, H, border, arcsim::Tangent::definite);
        system.add_laplacian(T0, H);
    }
    arcsim::VectorXd load() const {
        arcsim::VectorXd b = arcsim::VectorXd::LinSpaced(system.pattern().n_dofs(), -1, 2);
        system.fixed().clear(b);
        return b;
    }
    double error_of(const arcsim::LinearSolver& factor) const {   // |b - H x| / |b|
        const arcsim::VectorXd b = load(), x = factor.solve(b);
        arcsim::VectorXd Hx;
        H.multiply_symmetric(x, Hx);
        return (b - Hx).norm() / b.norm();
    }
};

}  // namespace

TEST_CASE("the tangent's factor is single precision where that is quick, and preconditions to double's digits") {
    Tangents t;
    t.make(100);
    TangentFactor factor(LinearSolverChoice::cholmod);
    factor.analyze(t.system.pattern());
    REQUIRE(factor.try_factorize(t.H));
    REQUIRE(factor.factorizations() == 1);
    const double error = t.error_of(factor.solver());
    REQUIRE(error < 1e-3);
    if (arcsim::own_factor_is_quick) REQUIRE(error > 1e-12);

    arcsim::FactorPcg pcg;
    arcsim::VectorXd x;
    const auto multiply = [&](const arcsim::VectorXd& v, arcsim::VectorXd& y) { t.H.multiply_symmetric(v, y); };
    const arcsim::PcgOutcome out = pcg.solve(multiply, factor.solver(), t.load(), 1e-12, 20, x);
    REQUIRE(out.status == arcsim::PcgStatus::converged);
    REQUIRE(out.iterations <= 6);

    TangentFactor dense(LinearSolverChoice::eigen);
    dense.analyze(t.system.pattern());
    REQUIRE(dense.try_factorize(t.H));
    REQUIRE(t.error_of(dense.solver()) < 1e-9);
    REQUIRE((dense.solver().solve(t.load()) - x).norm() < 1e-8 * x.norm());
}

TEST_CASE("an indefinite tangent is refused in both precisions, and the next definite one is taken") {
    Tangents t;
    TangentFactor factor(LinearSolverChoice::cholmod);
    factor.analyze(t.system.pattern());
    t.make(-10);
    REQUIRE_FALSE(factor.try_factorize(t.H));
    REQUIRE(factor.factorizations() == 1);   // one matrix, whatever the precisions
    t.make(10);
    REQUIRE(factor.try_factorize(t.H));
    REQUIRE(factor.factorizations() == 2);
    REQUIRE(t.error_of(factor.solver()) < 1e-3);
}
