#include "formwork/equilibrium/time_stepping.hpp"

#include <cmath>

#include "arcsim/base/text.hpp"

namespace formwork {

using arcsim::format_short;

namespace {

constexpr double shortest = 1. / 65536;        // of time_step: 16 halvings
constexpr double longest = 1e9;                // of time_step; beyond, inertia is long gone
constexpr int quick = 5, slow = 12;            // Newton iterations of a step
constexpr int steps_before_growing = 4;        // of the methods that stay in time
constexpr double time_accurate = 1e-6, on_the_way = 1e-3;   // precision of a converged step's balance

int step_limit(const SolverParams& p) { return static_cast<int>(std::min(1e8, std::ceil(p.end_time / p.time_step))); }

}  // namespace

TimeStepping::TimeStepping(StaticSystem& system, const EquilibriumProblem& problem)
    : IterativeMethod(system, problem, step_limit(problem.solver)), matrix_(system, problem) {
    const double damping = params_.damping;
    if (params_.method == SolverMethod::backward_euler) {
        step_ = std::make_unique<LinearisedEuler>(matrix_, damping);
    } else {
        const bool second_order = params_.method == SolverMethod::bdf2;
        step_ = std::make_unique<ConvergedStep>(system, matrix_, damping, second_order, second_order ? time_accurate : on_the_way);
    }
}

double TimeStepping::next_length(double h) const {
    if (params_.method == SolverMethod::newton_euler) {
        if (step_->iterations() > slow) return h / 2;
        return step_->iterations() <= quick ? std::min(2 * h, longest * params_.time_step) : h;
    }
    return h < params_.time_step && quick_steps_ >= steps_before_growing ? 2 * h : h;
}

SolveOutcome TimeStepping::solve(VectorXd& x, double tolerance, double, const std::string& phase) {
    const double start = arcsim::cpu_seconds();
    SolveOutcome out;
    Motion now, next;
    now.x = x;
    now.v.setZero(x.size());
    now.balance = system_.gradient(now.x, now.g);
    begin();
    step_->restart();
    double t = 0, h = params_.time_step;
    std::string why;
    while (!is_over(now.x, now.balance, tolerance, h, phase + ", t = " + format_short(t) + " s", out)) {
        const double floor = 0.1 * tolerance * now.balance.load;
        bool taken = step_->take(now, h, floor, next, why);
        if (taken && is_overstretched(now.x, next.x)) {
            why = "a face grows by more than a third in one step";
            taken = false;
        }
        if (!taken) {
            h /= 2;
            quick_steps_ = 0;
            step_->restart();
            if (h < shortest * params_.time_step) {
                out.status = SolveStatus::stalled;
                out.reason = "no step is short enough at t = " + format_short(t) + " s: " + why + ", also with the step halved to " +
                             format_short(2 * h) + " s";
                break;
            }
            continue;
        }
        t += h;
        ++iterations_;
        ++quick_steps_;
        std::swap(now, next);
        now.balance = system_.gradient(now.x, now.g);
        const double length = next_length(h);
        if (length != h) quick_steps_ = 0;
        h = length;
    }
    if (out.status == SolveStatus::out_of_iterations)
        out.reason = "not at rest after " + std::to_string(limit()) + " steps (t = " + format_short(t) + " s): residual " +
                     format_short(out.residual) + ". Raise solver/end_time of this stage, or use the method \"static\"";
    x = now.x;
    times_.symbolic = matrix_.cost().symbolic_s;
    times_.numeric = matrix_.cost().numeric_s;
    times_.assembly = matrix_.assembly_s();
    times_.solve = matrix_.solve_s();
    times_.total += arcsim::cpu_seconds() - start;
    return out;
}

}  // namespace formwork
