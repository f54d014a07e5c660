#pragma once

#include "arcsim/solve/linear_solver.hpp"
#include "formwork/equilibrium/iterative_method.hpp"

namespace formwork {

/// Projective dynamics without inertia, in the form that holds for any fabric [Liu, Bouaziz, Kavan 2017]: the global step's
/// matrix is constant,
///
///   L = k sum_t A_t grad_i . grad_j I,   k the fabric's stiffness,
///
/// factorised once for the whole run; each iteration is one evaluation of the forces and one pair of triangular solves,
/// accelerated by L-BFGS. Quick to a rough shape; the last digits take hundreds of iterations.
class ProjectiveMethod final : public IterativeMethod {
public:
    ProjectiveMethod(StaticSystem& system, const EquilibriumProblem& problem);

    SolveOutcome solve(VectorXd& x, double tolerance, double T0, const std::string& phase) override;
    int factorizations() const override { return solver_->cost().factorizations; }

private:
    struct Pair {
        VectorXd s, y;      // change of x and of g
        double rho = 0;     // 1 / (s . y)
    };
    void direction(const VectorXd& g, VectorXd& d);

    std::unique_ptr<arcsim::LinearSolver> solver_;
    std::vector<Pair> pairs_;   // oldest first
};

}  // namespace formwork
