#include "formwork/equilibrium/dynamic_relaxation.hpp"

#include <algorithm>
#include <cmath>

#include "arcsim/base/text.hpp"
#include "arcsim/solve/linear_solver.hpp"

namespace formwork {
namespace {

constexpr int steps_per_iteration = 100;   // one Newton step's worth of work, about: what max_iterations counts
constexpr int report_every = 25;
constexpr int renew_every = 200;           // steps without a peak
constexpr int most_doublings = 20;         // of the masses

}  // namespace

VectorXd absolute_row_sums(const BlockMatrix& A) {
    const arcsim::BlockPattern& p = A.pattern();
    VectorXd by_place = VectorXd::Zero(p.n_dofs());
    for (int c = 0; c < p.n_dofs(); ++c)
        for (int k = p.col_ptr()[c]; k < p.col_ptr()[c + 1]; ++k) {
            const int r = p.row_index()[k];
            if (r < c) continue;   // upper entries of diagonal blocks are not part of the matrix
            const double a = std::abs(A.values()[k]);
            by_place[r] += a;
            if (r != c) by_place[c] += a;
        }
    VectorXd sums(p.n_dofs());
    for (int i = 0; i < p.n_nodes(); ++i) sums.segment<3>(3 * i) = by_place.segment<3>(3 * p.place_of()[i]);
    return sums;
}

DynamicRelaxation::DynamicRelaxation(StaticSystem& system, const EquilibriumProblem& problem)
    : IterativeMethod(system, problem, steps_per_iteration * problem.solver.max_iterations, report_every),
      H_(system.pattern()) {}

void DynamicRelaxation::renew_masses(const VectorXd& x) {
    const double start = arcsim::cpu_seconds();
    system_.tangent(x, 0, H_, border_, arcsim::Tangent::exact);
    row_sum_ = absolute_row_sums(H_);
    // The level of a prescribed volume adds border border^T, which couples all nodes.
    if (border_.size() > 0) row_sum_ += border_.cwiseAbs() * border_.lpNorm<1>();
    mass_.resize(x.size());
    const double least = 1e-6 * row_sum_.maxCoeff();   // a node of slack faces alone has no stiffness at all
    for (Eigen::Index i = 0; i < x.size() / 3; ++i)
        mass_.segment<3>(3 * i).setConstant(margin_ * std::max(0.5 * row_sum_.segment<3>(3 * i).maxCoeff(), least));
    times_.assembly += arcsim::cpu_seconds() - start;
}

SolveOutcome DynamicRelaxation::solve(VectorXd& x, double tolerance, double, const std::string& phase) {
    const double start = arcsim::cpu_seconds();
    SolveOutcome out;
    VectorXd now = x, next, v = VectorXd::Zero(x.size()), g, force;
    VectorXd peak = x;
    begin();
    margin_ = 1;
    StaticSystem::Balance balance = system_.gradient(now, g);
    renew_masses(now);
    double kinetic = 0;
    int since = 0, doublings = 0;   // steps since the last renewal
    bool fresh = true;              // the next step starts from rest
    while (!is_over(now, balance, tolerance, 1, phase, out)) {
        force = -g;
        system_.fixed().clear(force);
        force.array() /= mass_.array();
        if (fresh) v = 0.5 * force;   // half a step: v lives between the positions
        else v += force;
        fresh = false;
        next = now + v;
        ++since;
        ++iterations_;
        const bool failed = is_overstretched(now, next);
        const double kinetic_next = 0.5 * v.dot(mass_.cwiseProduct(v));
        if (failed) {
            if (++doublings > most_doublings) {
                out.status = SolveStatus::stalled;
                out.reason = "dynamic relaxation does not settle, also with masses a million times as large";
                break;
            }
            margin_ *= 2;
            now = peak;
        } else if (kinetic_next < kinetic) {
            now += -0.5 * (v - force);   // half a step back from where the energy last grew: the peak lay about there
            peak = now;
        } else {
            now.swap(next);
            kinetic = kinetic_next;
            balance = system_.gradient(now, g);
            if (since >= renew_every) renew_masses(now), since = 0;
            continue;
        }
        balance = system_.gradient(now, g);
        renew_masses(now);
        kinetic = 0;
        since = 0;
        fresh = true;
    }
    if (out.status == SolveStatus::out_of_iterations)
        out.reason = "dynamic relaxation: residual " + arcsim::format_short(out.residual) + " after " + std::to_string(limit()) +
                     " steps. Raise solver/max_iterations of this stage, or use the method \"static\"";
    x = now;
    times_.total += arcsim::cpu_seconds() - start;
    return out;
}

}  // namespace formwork
