#pragma once

#include "formwork/equilibrium/iteration_log.hpp"
#include "formwork/equilibrium/method.hpp"

namespace formwork {

/// What the methods in time, dynamic relaxation and the projective method share: progress, history, and when to end.
class IterativeMethod : public EquilibriumMethod {
public:
    /// By a factorisation of its own: what these methods factorise, if anything, is another matrix.
    bool response(const VectorXd& x, const VectorXd& g, VectorXd& y) override;

    int iterations() const override { return iterations_; }
    const std::vector<IterationReport>& history() const override { return log_.reports(); }
    const SolverTimes& times() const override { return times_; }
    void allow_iterations(int) override { first_ = iterations_; }

protected:
    /// @param limit   iterations before it gives up
    /// @param every   of how many iterations one is reported
    IterativeMethod(StaticSystem& system, const EquilibriumProblem& problem, int limit, int every = 1);

    /// True when the iteration is over: converged, at the floor that rounding sets, run away, or out of iterations;
    /// `out` says which. Reports progress.
    /// @param step  what the report shows as the step taken
    bool is_over(const VectorXd& x, const StaticSystem::Balance& now, double tolerance, double step,
                 const std::string& phase, SolveOutcome& out);
    /// Starts counting the limit and the stagnation anew.
    void begin();
    int limit() const { return limit_; }

    /// Largest stretch that a step may lead to from x: a face that grows by a third at once has left the range in which
    /// its linearisation means anything.
    bool is_overstretched(const VectorXd& x, const VectorXd& next) const;

    StaticSystem& system_;
    SolverParams params_;
    int iterations_ = 0;
    SolverTimes times_;

private:
    double rounding_floor(const VectorXd& x, double load);

    IterationLog log_;
    VectorXd noisy_, g0_, g1_;
    int limit_, every_, first_ = 0, best_at_ = 0;
    double best_ = 0;
};

}  // namespace formwork
