#pragma once

#include "formwork/equilibrium/iterative_method.hpp"
#include "formwork/equilibrium/time_step.hpp"

namespace formwork {

/// Lets the bag move from rest until its forces balance.
///
/// A step that fails (matrix not definite, no convergence, a number that is not finite, a face that grows by a third at
/// once) is taken again at half its length; steps grow back to `time_step`. `newton_euler`, which needs no accuracy in
/// time to find the rest, lets its steps grow without limit while they converge quickly: it turns into Newton's method on
/// the equilibrium by itself. `bdf2` and `backward_euler` stay in time.
///
/// At the latest it stops after end_time / time_step steps.
class TimeStepping final : public IterativeMethod {
public:
    TimeStepping(StaticSystem& system, const EquilibriumProblem& problem);

    SolveOutcome solve(VectorXd& x, double tolerance, double T0, const std::string& phase) override;
    int factorizations() const override { return matrix_.cost().factorizations; }

private:
    double next_length(double h) const;

    StepMatrix matrix_;
    std::unique_ptr<TimeStep> step_;
    int quick_steps_ = 0;   // since the last change of length
};

}  // namespace formwork
