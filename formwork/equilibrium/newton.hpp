#pragma once

#include <functional>
#include <memory>
#include <string>

#include "arcsim/solve/gmres.hpp"
#include "arcsim/solve/linear_solver.hpp"
#include "arcsim/solve/pcg.hpp"
#include "formwork/equilibrium/iteration_log.hpp"
#include "formwork/equilibrium/method.hpp"
#include "formwork/equilibrium/tangent_factor.hpp"

namespace formwork {

/// Newton's method on the equilibrium, globalised (tension_field.md 5):
///
///   - the tangent is exact; T0 times the rest shape's Laplacian is added while the shape is far off and fades by
///     itself, so that the last steps are quadratic. T0 starts at the final load's tension T* = p R: a flat sheet then
///     bulges smoothly at once;
///   - the linear system is solved by conjugate gradients on an older factor; a new factor is made only when those need
///     too many iterations or meet negative curvature;
///     A law that is strongly unsymmetric gets GMRES with the whole tangent on a factor of its definite part (with the
///     symmetric half alone a woven sock takes hundreds of steps), and LU where that fails;
///   - a step is shortened, by false position, until the force along it has nearly vanished: no energy is needed, so laws
///     without potential are welcome.
class NewtonSolver final : public EquilibriumMethod {
public:
    NewtonSolver(StaticSystem& system, const SolverParams& params,
                 std::function<void(const IterationReport&)> on_iteration);

    SolveOutcome solve(VectorXd& x, double tolerance, double T0, const std::string& phase) override;

    bool response(const VectorXd& x, const VectorXd& g, VectorXd& y) override;   // by the factor at hand

    int iterations() const override { return iterations_; }
    int factorizations() const override {
        return factor_.factorizations() + (lu_ ? lu_->cost().factorizations : 0);
    }
    const std::vector<IterationReport>& history() const override { return log_.reports(); }
    const SolverTimes& times() const override { return times_; }
    void allow_iterations(int more) override { limit_ = iterations_ + more; }

private:
    bool direction(double& T0, double relative);
    bool direction_unsymmetric(const VectorXd& x, double& T0, double relative, bool any_direction);
    bool direction_by_gmres(const VectorXd& x, double T0, double relative);
    bool direction_by_lu();
    bool factorize_definite(const VectorXd& x, double T0);
    bool factorize_regularised(double& T0);
    double rounding_floor(const VectorXd& x, double load);

    StaticSystem& system_;
    SolverParams params_;
    IterationLog log_;
    TangentFactor factor_;
    std::unique_ptr<BlockMatrix> definite_;      // of strongly unsymmetric laws
    std::unique_ptr<arcsim::LinearSolver> lu_;   // for those where GMRES fails
    arcsim::FactorPcg pcg_;
    arcsim::FactorGmres gmres_;
    BlockMatrix H_;
    VectorXd border_, g_, d_, trial_g_, rhs_;
    bool factor_is_stale_ = true;
    int iterations_ = 0, limit_;
    double T_ref_;
    SolverTimes times_;
};

}  // namespace formwork
