#include "formwork/equilibrium/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace formwork {

using arcsim::cpu_seconds;
using arcsim::PcgStatus;

namespace {

constexpr int pcg_limit = 60;            // beyond, a new factor is cheaper
constexpr int pcg_refactor_next = 24;    // beyond, the next step gets a new factor
constexpr double fade_below = 1e-6;      // of T*: smaller regularisations are set to nothing
constexpr double wake_at = 1e-4;         // of T*: the first one tried where the tangent is not definite
constexpr double largest_step = 0.5;     // of the rest shape's half width per Newton step
constexpr int most_trials = 12;          // of a step's length
// A step ends where the pull along it is between these parts of the first one: among the kinks of a wrinkling fabric
// steps that may overshoot by half run in circles for dozens of iterations.
constexpr double least_pull = -0.1;
constexpr double most_pull = 0.5;        // a full step may keep more
constexpr int patience = 60;             // Newton steps without a new best residual
constexpr double newton_is_trusted_at = 1e-2;   // relative residual; unsymmetric laws
constexpr double residual_may_grow = 10;

struct Stopwatch {
    double& sum;
    double start = cpu_seconds();
    explicit Stopwatch(double& s) : sum(s) {}
    ~Stopwatch() { sum += cpu_seconds() - start; }
};

}  // namespace

NewtonSolver::NewtonSolver(StaticSystem& system, const SolverParams& params,
                           std::function<void(const IterationReport&)> on_iteration)
    : system_(system), params_(params), log_(system, std::move(on_iteration)),
      factor_(params.linear_solver),
      H_(system.pattern(), system.membrane().law().is_strongly_unsymmetric() ? BlockMatrix::Kind::general
                                                                             : BlockMatrix::Kind::symmetric),
      limit_(params.max_iterations), T_ref_(system.scales().tension) {
    factor_.analyze(system.pattern());
    times_.ordering = system.ordering_s();
}

/// Factorises the tangent, raising T0 until it is positive definite. With an unknown level the tangent at a fixed level may
/// well be indefinite where the whole is not (a bag that balloons at a level is stable at a volume): then only the
/// preconditioner is raised, and conjugate gradients judge the whole.
bool NewtonSolver::factorize_regularised(double& T0) {
    double borrowed = 0;
    bool ok = false;
    for (int attempt = 0; attempt < 12 && !ok; ++attempt) {
        {
            Stopwatch watch(times_.numeric);
            ok = factor_.try_factorize(H_);
        }
        times_.symbolic = factor_.symbolic_s();
        if (ok) break;
        const double raised = std::max(10 * (T0 + borrowed), wake_at * T_ref_);
        system_.add_laplacian(raised - T0 - borrowed, H_);
        (border_.size() > 0 ? borrowed : T0) = raised - (border_.size() > 0 ? T0 : 0);
    }
    if (borrowed > 0) system_.add_laplacian(-borrowed, H_);
    factor_is_stale_ = !ok;
    return ok;
}

/// d = -(H + border border^T)^-1 g.
bool NewtonSolver::direction(double& T0, double relative) {
    rhs_ = -g_;
    system_.fixed().clear(rhs_);
    const auto multiply = [&](const VectorXd& v, VectorXd& y) {
        H_.multiply_symmetric(v, y);
        if (border_.size() > 0) y += border_ * border_.dot(v);
    };
    const double eta = std::clamp(relative * relative, 1e-3, 0.1);
    for (int attempt = 0; attempt < 8; ++attempt) {
        const bool fresh = factor_is_stale_;
        if (fresh && !factorize_regularised(T0)) return false;
        arcsim::PcgOutcome out;
        {
            Stopwatch watch(times_.solve);
            out = pcg_.solve(multiply, factor_.solver(), rhs_, eta, pcg_limit, d_);
        }
        if (out.status == PcgStatus::converged) {
            factor_is_stale_ = out.iterations > pcg_refactor_next;
            return true;
        }
        if (out.status == PcgStatus::out_of_iterations) {
            factor_is_stale_ = true;
            if (!fresh) continue;
            return true;                                               // a poor but descending direction
        }
        // Negative curvature is the tangent's own, whatever the preconditioner: no factorisation would help.
        const double raised = std::max(10 * T0, wake_at * T_ref_);
        system_.add_laplacian(raised - T0, H_);
        T0 = raised;
    }
    return false;
}

bool NewtonSolver::response(const VectorXd& x, const VectorXd& g, VectorXd& y) {
    system_.gradient(x, g_);   // brings the level to x
    {
        Stopwatch watch(times_.assembly);
        system_.tangent(x, 0, H_, border_, arcsim::Tangent::exact);
    }
    g_ = g;
    system_.fixed().clear(g_);
    double T0 = 0;
    const bool found = H_.is_general() ? direction_unsymmetric(x, T0, 0, true) : direction(T0, 0);
    y = d_;
    return found && T0 == 0;
}

/// Noise of the residual: what a change of every coordinate by half a unit in its last place does to the forces.
double NewtonSolver::rounding_floor(const VectorXd& x, double load) {
    const VectorXd noise = rounding_noise(system_, x);
    VectorXd force;
    H_.multiply_symmetric(noise, force);
    system_.fixed().clear(force);
    return force.norm() / load;
}

SolveOutcome NewtonSolver::solve(VectorXd& x, double tolerance, double T0, const std::string& phase) {
    Stopwatch total(times_.total);
    SolveOutcome out;
    const double longest_allowed = largest_step * system_.scales().reach;
    StaticSystem::Balance now;
    {
        Stopwatch watch(times_.line_search);
        now = system_.gradient(x, g_);
    }
    double step = 1;
    int slow = 0, best_at = iterations_;
    double best = std::numeric_limits<double>::infinity();
    for (;; ++iterations_) {
        out.residual = system_.relative(now);
        const double stretch = log_.add({iterations_, out.residual, factorizations(), step, 0, phase}, x);
        if (!std::isfinite(out.residual)) {
            out.status = SolveStatus::runaway;
            return out;
        }
        if (out.residual <= tolerance) {
            out.status = SolveStatus::converged;
            return out;
        }
        if (stretch > runaway_stretch) {
            out.status = SolveStatus::runaway;
            return out;
        }
        if (out.residual < 0.9 * best) best = out.residual, best_at = iterations_;
        if (iterations_ >= limit_ || iterations_ - best_at > patience) {
            out.status = SolveStatus::out_of_iterations;
            return out;
        }
        if (T0 < fade_below * T_ref_) T0 = 0;
        {
            Stopwatch watch(times_.assembly);
            system_.tangent(x, T0, H_, border_, arcsim::Tangent::exact);
        }
        if (out.residual < 1e-5) {
            out.rounding_floor = rounding_floor(x, now.residual / out.residual);
            // At the floor, and no longer falling: rounding, not lack of convergence.
            if (slow >= 2 && out.residual < 4 * out.rounding_floor) {
                out.status = SolveStatus::rounding_floor;
                return out;
            }
        }
        // Near the solution of an unsymmetric law Newton's direction need not pull forward; the residual judges it then.
        const bool by_residual = H_.is_general() && out.residual < newton_is_trusted_at;
        const bool found = H_.is_general() ? direction_unsymmetric(x, T0, out.residual, by_residual) : direction(T0, out.residual);
        if (!found) {
            out.status = SolveStatus::stalled;
            return out;
        }
        Stopwatch watch(times_.line_search);
        const double longest = d_.lpNorm<Eigen::Infinity>();
        if (longest > longest_allowed) d_ *= longest_allowed / longest;
        // Along d the fabric pulls forward at first (slope > 0).
        const double slope = -d_.dot(g_);
        const bool halves = by_residual || system_.seams().may_push();   // springs that push have no least energy along d
        step = 1;
        VectorXd trial;
        StaticSystem::Balance there;
        double low = 0, high = 1, low_pull = slope, high_pull = 0;   // around the step at which the pull vanishes
        for (int trials = 0;; ++trials) {
            trial = x + step * d_;
            there = system_.gradient(trial, trial_g_);
            const double pull = -d_.dot(trial_g_);
            const bool pulls = std::isfinite(pull) && pull >= (halves ? -0.5 : least_pull) * slope;
            if (!by_residual && pulls && (halves || step == 1 || pull <= most_pull * slope)) break;
            // A full step may meet a kink of the table and still be a good one; shorter ones have to gain. Where the fabric
            // pulls forward, its pull judges as well: the residual alone gets caught among kinks.
            if (by_residual && there.residual < (trials == 0 ? 2 : 1) * now.residual) break;
            if (by_residual && pulls && slope > 0 && there.residual < residual_may_grow * now.residual) break;
            if (trials == most_trials) break;
            if (halves || !std::isfinite(pull)) {
                high = step;
                step *= 0.5;
                continue;
            }
            if (pull > 0) low = step, low_pull = pull;
            else high = step, high_pull = pull;
            const double zero = (low * high_pull - high * low_pull) / (high_pull - low_pull), margin = 0.1 * (high - low);
            step = std::clamp(zero, low + margin, high - margin);
        }
        slow = there.residual > 0.5 * now.residual ? slow + 1 : 0;
        x = trial;
        std::swap(g_, trial_g_);
        now = there;
        if (by_residual) T0 /= 10;
        else if (step >= 0.9) T0 /= 10;
        else if (step >= 0.4) T0 /= 2;
        else if (step >= 0.15) T0 = std::max(2 * T0, wake_at * T_ref_);
        else T0 = std::max(8 * T0, wake_at * T_ref_);
    }
}

}  // namespace formwork
