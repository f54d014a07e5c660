#include "formwork/equilibrium/time_step.hpp"

#include <cmath>

#include "arcsim/base/text.hpp"

namespace formwork {
namespace {

constexpr int most_newton = 20;     // per step; beyond, the step is too long
constexpr int most_cuts = 8;

}  // namespace

bool LinearisedEuler::take(const Motion& now, double h, double, Motion& next, std::string& why) {
    if (!matrix_.factorize(now.x, h * (h + damping_), h * h)) {
        why = "the step's matrix is not positive definite: the liquid pushes harder than fabric and inertia hold";
        return false;
    }
    rhs_ = matrix_.mass().cwiseProduct(now.v) - h * now.g;
    matrix_.solve(rhs_, next.v);
    next.x = now.x + h * next.v;
    return true;
}

ConvergedStep::ConvergedStep(StaticSystem& system, StepMatrix& matrix, double damping, bool second_order, double precision)
    : system_(system), matrix_(matrix), damping_(damping), precision_(precision), second_order_(second_order) {
    if (damping > 0) damper_ = std::make_unique<BlockMatrix>(system.pattern());
}

double ConvergedStep::residual(const VectorXd& v, VectorXd& r) {
    x_ = from_ + h_ * v;
    system_.gradient(x_, r);
    if (damper_) {
        damper_->multiply_symmetric(v, product_);
        r += damping_ * product_;
    }
    r += matrix_.mass().cwiseProduct(v - carried_) / h_;
    system_.fixed().clear(r);
    return r.norm();
}

/// One Newton iteration on v.
bool ConvergedStep::improve(VectorXd& v, std::string& why) {
    if (!matrix_.factorize(from_ + h_ * v, h_ * h_, h_ * h_, damper_.get(), h_ * damping_)) {
        why = "the step's matrix is not positive definite";
        return false;
    }
    matrix_.solve(-h_ * r_, dv_);
    const double slope = -dv_.dot(r_);
    if (!dv_.allFinite()) {
        why = "the step's matrix is singular";
        return false;
    }
    double alpha = 1;
    for (int halving = 0; halving <= most_cuts; ++halving, alpha /= 2) {
        trial_ = v + alpha * dv_;
        const double there = residual(trial_, trial_r_);
        // LU's direction need not pull forward: the residual judges it then.
        const bool good = slope > 0 ? -dv_.dot(trial_r_) >= -0.5 * slope : there < now_;
        if (!std::isfinite(there) || !good) continue;
        v.swap(trial_);
        r_.swap(trial_r_);
        now_ = there;
        return true;
    }
    why = "no step along Newton's direction helps";
    return false;
}

bool ConvergedStep::take(const Motion& now, double h, double floor, Motion& next, std::string& why) {
    const bool with_memory = second_order_ && previous_h_ == h;
    h_ = with_memory ? 2 * h / 3 : h;
    from_ = with_memory ? VectorXd((4 * now.x - previous_x_) / 3) : now.x;
    carried_ = with_memory ? VectorXd((4 * now.v - previous_v_) / 3) : now.v;
    if (damper_) {
        arcsim::State s;
        s.x = with_memory ? VectorXd(now.x + h * now.v) : now.x;   // predicted to second order
        damper_->set_zero();
        system_.membrane().add_hessian(s, arcsim::Tangent::definite, *damper_);
    }
    VectorXd v = now.v;
    now_ = residual(v, r_);
    VectorXd momentum = matrix_.mass().cwiseProduct(now.v) / h_;
    const double goal = std::max(floor, precision_ * std::max(now.balance.residual, momentum.norm()));
    for (iterations_ = 0; !(now_ <= goal);) {
        if (iterations_ == most_newton) {
            why = "no convergence in " + std::to_string(most_newton) + " Newton iterations, " + arcsim::format_short(now_) + " N left";
            return false;
        }
        ++iterations_;
        if (!improve(v, why)) return false;
    }
    previous_x_ = now.x;
    previous_v_ = now.v;
    previous_h_ = h;
    next.v = v;
    next.x = from_ + h_ * v;
    return true;
}

}  // namespace formwork
