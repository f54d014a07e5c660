#include "formwork/equilibrium/projective.hpp"

#include <cmath>

#include "arcsim/base/text.hpp"

namespace formwork {
namespace {

constexpr std::size_t memory = 8;          // pairs; [Liu, Bouaziz, Kavan 2017] find 5 to 10 best
constexpr int per_iteration = 20;          // one Newton step's worth of work, about: what max_iterations counts
constexpr int most_backtracks = 12;
constexpr double longest_move = 0.5;       // of the rest shape's half width

}  // namespace

ProjectiveMethod::ProjectiveMethod(StaticSystem& system, const EquilibriumProblem& problem)
    : IterativeMethod(system, problem, per_iteration * problem.solver.max_iterations),
      solver_(arcsim::make_linear_solver(arcsim::SolverKind::cholmod)) {
    BlockMatrix L(system.pattern());
    system.add_laplacian(system.membrane().law().rest_stiffness(), L);
    solver_->analyze(system.pattern());
    solver_->factorize(L);
    times_.symbolic = solver_->cost().symbolic_s;
    times_.numeric = solver_->cost().numeric_s;
}

/// d = -(L-BFGS approximation of the inverse tangent) g, L the start of the recursion [Nocedal 1980].
void ProjectiveMethod::direction(const VectorXd& g, VectorXd& d) {
    VectorXd q = -g;
    std::vector<double> alpha(pairs_.size());
    for (std::size_t k = pairs_.size(); k-- > 0;) {
        alpha[k] = pairs_[k].rho * pairs_[k].s.dot(q);
        q -= alpha[k] * pairs_[k].y;
    }
    const double start = arcsim::cpu_seconds();
    solver_->solve(q, d);
    times_.solve += arcsim::cpu_seconds() - start;
    for (std::size_t k = 0; k < pairs_.size(); ++k) d += (alpha[k] - pairs_[k].rho * pairs_[k].y.dot(d)) * pairs_[k].s;
}

SolveOutcome ProjectiveMethod::solve(VectorXd& x, double tolerance, double, const std::string& phase) {
    const double start = arcsim::cpu_seconds();
    SolveOutcome out;
    VectorXd g, d, trial, trial_g;
    StaticSystem::Balance now = system_.gradient(x, g);
    system_.fixed().clear(g);
    begin();
    pairs_.clear();
    double step = 1;
    while (!is_over(x, now, tolerance, step, phase, out)) {
        direction(g, d);
        double slope = -d.dot(g);
        if (!(slope > 0)) {   // the memory misleads: forget it
            pairs_.clear();
            direction(g, d);
            slope = -d.dot(g);
        }
        const double longest = d.lpNorm<Eigen::Infinity>(), allowed = longest_move * system_.scales().reach;
        if (longest > allowed) d *= allowed / longest, slope *= allowed / longest;
        StaticSystem::Balance there;
        step = 1;
        bool good = false;
        for (int halving = 0; halving <= most_backtracks; ++halving, step /= 2) {
            trial = x + step * d;
            there = system_.gradient(trial, trial_g);
            system_.fixed().clear(trial_g);
            const double pull = -d.dot(trial_g);
            good = std::isfinite(pull) && pull >= -0.5 * slope && !is_overstretched(x, trial);
            if (good) break;
        }
        if (!good) {
            if (pairs_.empty()) {
                out.status = SolveStatus::stalled;
                out.reason = "no step of the projective method helps, residual " + arcsim::format_short(out.residual);
                break;
            }
            pairs_.clear();
            continue;
        }
        Pair p{trial - x, trial_g - g, 0};
        const double curvature = p.s.dot(p.y);
        if (curvature > 1e-12 * p.s.norm() * p.y.norm()) {
            p.rho = 1 / curvature;
            if (pairs_.size() == memory) pairs_.erase(pairs_.begin());
            pairs_.push_back(std::move(p));
        }
        x.swap(trial);
        g.swap(trial_g);
        now = there;
        ++iterations_;
    }
    if (out.status == SolveStatus::out_of_iterations)
        out.reason = "the projective method: residual " + arcsim::format_short(out.residual) + " after " + std::to_string(limit()) +
                     " iterations. Raise solver/max_iterations of this stage, or use the method \"static\"";
    times_.total += arcsim::cpu_seconds() - start;
    return out;
}

}  // namespace formwork
