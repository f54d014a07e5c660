#include <algorithm>
#include <cmath>

#include "formwork/equilibrium/run.hpp"

namespace formwork {
namespace {

constexpr double prestress_part = 0.01;        // Tp = 0.01 T* (tension_field.md 3)
// r = Tp / (0.5 k_max): no Green strain is below -1/2, so that the residual's compression r k e never exceeds Tp and the
// membrane stays convex. (tension_field.md 3 takes 0.25 k at rest; crumpled dry cloth is compressed further than that.)
constexpr double residual_part = 0.5;
constexpr double wrinkles_known_at = 1e-3;     // residual at which the wrinkled region is settled enough to judge
constexpr int most_rounds = 6;

}  // namespace

Regulariser Run::regulariser(double prestress) const {
    return {std::min(1.0, prestress / (residual_part * system_.membrane().law().largest_stiffness())), prestress};
}

void Run::solve_tension_field(const Goal& goal) {
    const double T = system_.scales().tension;
    if (from_coarse_ && coarse_prestress_part_ == 0 && finish_without_prestress(goal.tolerance)) return;
    const double part = from_coarse_ && coarse_prestress_part_ > 0 ? coarse_prestress_part_ : prestress_part;
    const Regulariser first = regulariser(part * T);
    system_.membrane().law().set_regulariser(first);
    const double rough = std::max(wrinkles_known_at, goal.tolerance);
    outcome_ = solve_with_level(rough, T, "prestressed");   // what is carried over from a coarse mesh is rough where it wrinkles
    if (!outcome_.ok() && from_coarse_) {
        start_afresh();
        outcome_ = solve_with_level(rough, T, "prestressed");
    }
    if (!outcome_.ok() && !(is_newton() && approach_from_full(goal.tolerance, first.Tp))) explain_failure();
    if (count_wrinkles(system_.membrane(), x_).sum() == 0 && finish_without_prestress(goal.tolerance)) return;
    if (rough > goal.tolerance) solve_or_throw(goal.tolerance, 0, "prestressed");
    lower_prestress(goal);
}

/// Where the relaxed law finds no way, begin with the full one, which resists compression, and take that resistance away
/// step by step. The last r that works stays; its effect is reported.
bool Run::approach_from_full(double tolerance, double prestress) {
    MembraneLaw& law = system_.membrane().law();
    const double target = regulariser(prestress).r;
    const VectorXd lost = x_;
    const SolveOutcome failed = outcome_;
    VectorXd good;
    Regulariser held;
    start_afresh();
    for (double r = 1; r > 0.999 * target; r = r > target ? std::max(target, r / 3) : 0) {
        law.set_regulariser({r, prestress});
        method_->allow_iterations(p_.solver.max_iterations / 2);
        const SolveOutcome there = solve_with_level(tolerance, good.size() == 0 ? system_.scales().tension : 0, "residual " + short_number(r));
        if (!there.ok()) break;
        good = x_;
        held = law.regulariser();
        outcome_ = there;
    }
    method_->allow_iterations(p_.solver.max_iterations);
    if (good.size() == 0) {
        x_ = lost;
        outcome_ = failed;
        law.set_regulariser(regulariser(prestress));
        return false;
    }
    x_ = good;
    law.set_regulariser(held);
    if (held.r > 1.001 * target)
        warnings_.push_back("the fabric keeps " + short_number(100 * held.r) +
                            " % of its resistance to compression: with less no equilibrium was found. A free edge under "
                            "the liquid's surface flaps like that: hold it, or lower the fill");
    return true;
}

/// Two values of Tp and r give their effect, and with it how small they have to be. The second value is half of both, by one
/// Newton step from the first: at a fixed shape the forces are linear in Tp and r.
void Run::estimate_effect() {
    MembraneLaw& law = system_.membrane().law();
    const Regulariser r = law.regulariser();
    const Extent here = measure_extent(system_, x_);
    regularisation_ = {r.Tp, r.r, 1, 1, here.depth, here.volume};
    VectorXd g, half_g, step;
    system_.gradient(x_, g);
    law.set_regulariser({0.5 * r.r, 0.5 * r.Tp});
    system_.gradient(x_, half_g);
    law.set_regulariser(r);
    if (!method_->response(x_, g - half_g, step)) {
        warnings_.push_back("the effect of the prestress of " + short_number(r.Tp) +
                            " N/m could not be estimated: the equilibrium is not a stable one");
        return;
    }
    constexpr double part = 1e-2;   // of the step: first order alone
    const Extent there = measure_extent(system_, x_ + part * step);
    measure_extent(system_, x_);    // back to this shape's level
    set_effect(here, {2 / part * (there.depth - here.depth), 2 / part * (there.volume - here.volume)});
}

/// `change`: of depth and volume when the rest of the prestress goes.
void Run::set_effect(const Extent& here, const Extent& change) {
    regularisation_.depth_extrapolated_m = here.depth + change.depth;
    regularisation_.volume_extrapolated_m3 = here.volume + change.volume;
    regularisation_.depth_effect = std::abs(change.depth) / std::max(std::abs(here.depth), 1e-300);
    regularisation_.volume_effect = std::abs(change.volume) / std::max(std::abs(here.volume), 1e-300);
}

/// From the two equilibria at Tp and at Tp / less: where the lowest point lies among wrinkles, the slope at one of them
/// alone was off by a factor of four.
void Run::estimate_from(const Extent& before, double less) {
    const Regulariser r = system_.membrane().law().regulariser();
    const Extent here = measure_extent(system_, x_);
    regularisation_ = {r.Tp, r.r, 0, 0, here.depth, here.volume};
    const double left = less / (1 - less);
    set_effect(here, {left * (here.depth - before.depth), left * (here.volume - before.volume)});
}

/// The effect of Tp from the equilibrium at 2 Tp, for meshes that find none below Tp; x_ stays.
void Run::estimate_from_above() {
    MembraneLaw& law = system_.membrane().law();
    const Regulariser now = law.regulariser();
    const VectorXd x = x_;
    const SolveOutcome outcome = outcome_;
    const Extent here = measure_extent(system_, x_);
    law.set_regulariser({std::min(1.0, 2 * now.r), 2 * now.Tp});
    method_->allow_iterations(p_.solver.max_iterations);
    if (solve_with_level(1e-6, 0, "prestress " + short_number(2 * now.Tp)).ok()) {
        const Extent above = measure_extent(system_, x_);
        set_effect(here, {here.depth - above.depth, here.volume - above.volume});
    }
    x_ = x;
    outcome_ = outcome;
    law.set_regulariser(now);
    measure_extent(system_, x_);
}

void Run::lower_prestress(const Goal& goal) {
    MembraneLaw& law = system_.membrane().law();
    estimate_effect();
    // By halves, so that the prestress that is left does not depend on the last digits of an estimate, nor on the start.
    int boldest = 2;   // halvings at once
    for (int round = 0; round < most_rounds && worst_effect() > goal.allowed_effect && boldest > 0; ++round) {
        const Regulariser now = law.regulariser();
        const double wanted = std::ceil(std::log2(worst_effect() / goal.allowed_effect));
        const int halvings = static_cast<int>(std::clamp(wanted, 1.0, double(boldest)));
        const double less = std::ldexp(1.0, -halvings);
        const VectorXd good = x_;
        const SolveOutcome good_outcome = outcome_;
        const Regularisation good_estimate = regularisation_;
        const Extent before = measure_extent(system_, x_);
        law.set_regulariser({less * now.r, less * now.Tp});
        method_->allow_iterations(p_.solver.max_iterations);
        outcome_ = solve_with_level(goal.tolerance, 0, "prestress " + short_number(less * now.Tp));
        if (outcome_.ok()) {
            estimate_from(before, less);
            continue;
        }
        // Too far at once, or less prestress than this mesh needs to be well posed: back to the last good one.
        x_ = good;
        outcome_ = good_outcome;
        law.set_regulariser(now);
        regularisation_ = good_estimate;
        boldest = halvings - 1;
    }
    if (boldest == 0) estimate_from_above();
    if (worst_effect() > goal.allowed_effect)
        warnings_.push_back("the prestress could not be lowered below " + short_number(law.regulariser().Tp) +
                            " N/m; its effect is about " + short_number(100 * regularisation_.depth_effect) + " % on depth, " +
                            short_number(100 * regularisation_.volume_effect) + " % on volume");
}

/// @returns false when wrinkles appear once the prestress is gone; then x_ is where it was
bool Run::finish_without_prestress(double tolerance) {
    const VectorXd before = x_;
    const Regulariser prestressed = system_.membrane().law().regulariser();
    system_.membrane().law().set_regulariser({});
    outcome_ = solve_with_level(tolerance, 0, "final");
    if (outcome_.ok() && count_wrinkles(system_.membrane(), x_).sum() == 0) return true;
    if (!outcome_.ok()) method_->allow_iterations(p_.solver.max_iterations);
    x_ = before;
    system_.membrane().law().set_regulariser(prestressed);
    return false;
}

}  // namespace formwork
