#include "formwork/equilibrium/iterative_method.hpp"

#include <cmath>
#include <limits>

#include "arcsim/solve/linear_solver.hpp"

namespace formwork {
namespace {

constexpr double largest_growth = 4. / 3;   // of a face's stretch in one step
constexpr int floor_patience = 5;           // reports without gain before rounding is suspected

}  // namespace

IterativeMethod::IterativeMethod(StaticSystem& system, const EquilibriumProblem& problem, int limit, int every)
    : system_(system), params_(problem.solver), log_(system, problem.on_iteration), limit_(limit), every_(every) {
    times_.ordering = system.ordering_s();
}

void IterativeMethod::begin() {
    first_ = best_at_ = iterations_;
    best_ = std::numeric_limits<double>::infinity();
}

bool IterativeMethod::is_overstretched(const VectorXd& x, const VectorXd& next) const {
    const MembraneForce& m = system_.membrane();
    return !next.allFinite() || !(m.stretch_range(next)[0] <= largest_growth * std::max(1.0, m.stretch_range(x)[0]));
}

bool IterativeMethod::response(const VectorXd& x, const VectorXd& g, VectorXd& y) {
    const bool unsymmetric = system_.membrane().law().is_strongly_unsymmetric();
    BlockMatrix H(system_.pattern(), unsymmetric ? BlockMatrix::Kind::general : BlockMatrix::Kind::symmetric);
    VectorXd border, rhs = -g;
    system_.update_level(x);
    system_.tangent(x, 0, H, border, arcsim::Tangent::exact);
    system_.fixed().clear(rhs);
    const auto solver = arcsim::make_linear_solver(unsymmetric ? arcsim::SolverKind::umfpack : arcsim::SolverKind::cholmod);
    solver->analyze(system_.pattern());
    if (!solver->try_factorize(H)) return false;
    solver->solve(rhs, y);
    if (border.size() > 0) {   // Sherman and Morrison: the unknown level
        const VectorXd s = solver->solve(border);
        y -= border.dot(y) / (1 + border.dot(s)) * s;
    }
    return true;
}

/// Noise of the residual: what a change of every coordinate by half a unit in its last place does to the forces.
double IterativeMethod::rounding_floor(const VectorXd& x, double load) {
    constexpr double magnified = 1e3;   // so that the difference is not itself rounding
    noisy_ = x + magnified * rounding_noise(system_, x);
    system_.gradient(noisy_, g1_);
    system_.gradient(x, g0_);
    g1_ -= g0_;
    system_.fixed().clear(g1_);
    return g1_.norm() / magnified / load;
}

bool IterativeMethod::is_over(const VectorXd& x, const StaticSystem::Balance& now, double tolerance, double step,
                              const std::string& phase, SolveOutcome& out) {
    out.residual = system_.relative(now);
    const bool finite = std::isfinite(out.residual);
    const bool converged = finite && out.residual <= tolerance;
    const bool exhausted = iterations_ - first_ >= limit_;
    if (out.residual < 0.9 * best_) best_ = out.residual, best_at_ = iterations_;
    if (iterations_ % every_ != 0 && finite && !converged && !exhausted) return false;

    const double stretch = log_.add({iterations_, out.residual, factorizations(), step, 0, phase}, x);
    if (converged) {
        out.status = SolveStatus::converged;
        return true;
    }
    if (!finite || !(stretch <= runaway_stretch)) {
        out.status = SolveStatus::runaway;
        return true;
    }
    if (out.residual < 1e-5 && iterations_ - best_at_ >= floor_patience * every_) {
        out.rounding_floor = rounding_floor(x, out.residual > 0 ? now.residual / out.residual : 1);
        if (out.residual < 4 * out.rounding_floor) {
            out.status = SolveStatus::rounding_floor;
            return true;
        }
    }
    if (exhausted) out.status = SolveStatus::out_of_iterations;
    return exhausted;
}

}  // namespace formwork
