#pragma once

#include "arcsim/solve/linear_solver.hpp"
#include "formwork/equilibrium/static_system.hpp"

namespace formwork {

/// The bag's lumped masses and the matrix of an implicit step (SYSTEM row 10, H = -J),
///
///   A = M + w_fabric H_fabric + w_other H_other,   other: liquid, seams,
///
/// with held rows fixed and the level of a prescribed volume eliminated (a rank-one term). Cholesky takes its symmetric
/// half; with `umfpack`, or a law that is strongly unsymmetric, LU takes the whole.
class StepMatrix {
public:
    /// @throws InputError: the fabric has no mass
    StepMatrix(StaticSystem& system, const EquilibriumProblem& problem);

    const VectorXd& mass() const { return mass_; }   // 3n, kg

    /// Factorises A at x with the exact tangent of the fabric; where that is not positive definite, with its definite one.
    /// LU takes whatever is not singular.
    /// @param damper  a further matrix of the same pattern to add `w_damper` times, or none
    /// @returns false when neither can be factorised
    bool factorize(const VectorXd& x, double w_fabric, double w_other, const BlockMatrix* damper = nullptr,
                   double w_damper = 0);
    /// d = A⁻¹ rhs, zero at held entries.
    void solve(const VectorXd& rhs, VectorXd& d);
    bool is_general() const { return A_.is_general(); }
    const arcsim::FactorCost& cost() const { return solver_->cost(); }
    double assembly_s() const { return assembly_s_; }
    double solve_s() const { return solve_s_; }

private:
    StaticSystem& system_;
    std::unique_ptr<arcsim::LinearSolver> solver_;
    BlockMatrix A_;
    VectorXd mass_, border_, bordered_, rhs_;
    double assembly_s_ = 0, solve_s_ = 0;
};

}  // namespace formwork
