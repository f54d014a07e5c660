#include "arcsim/solve/limit_projection.hpp"

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "arcsim/solve/limit_rounds.hpp"

namespace arcsim {

LimitProjection::LimitProjection(ClothSystem& system) : system_(system), K_(system.pattern()), H_(system.pattern()) {}

void LimitProjection::apply(const BlockMatrix& A, double h, VectorXd& x, VectorXd& v) {
    ClothModel& model = system_.model();
    if (model.limits->is_idle(x)) return;
    start_ = x;
    VectorXd dv = VectorXd::Zero(x.size());
    LimitRounds rounds(model, h);
    do {
        minimise(A, h, dv);
    } while (!rounds.are_done(start_ + h * dv));
    x = start_ + h * dv;
    v += dv;
}

double LimitProjection::energy(const BlockMatrix& A, double h, const VectorXd& dv) {
    A.multiply_symmetric(dv, Adv_);
    trial_.x = start_ + h * dv;
    return 0.5 * dv.dot(Adv_) + *system_.model().limits->energy(trial_);
}

void LimitProjection::minimise(const BlockMatrix& A, double h, VectorXd& dv) {
    constexpr int max_iterations = 60;
    constexpr double tolerance = 1e-9;   // of the residual, relative to the limits' largest force
    const StrainLimitForce& limits = *system_.model().limits;
    const auto& held = system_.model().held;
    double now = energy(A, h, dv);
    for (int iteration = 0; iteration < max_iterations; ++iteration) {
        trial_.x = start_ + h * dv;
        A.multiply_symmetric(dv, Adv_);
        g_.setZero(dv.size());
        limits.add_gradient(trial_, g_);
        r_ = Adv_ + h * g_;
        for (const HeldNode& n : held) r_.segment<3>(3 * n.node).setZero();
        if (r_.cwiseAbs().maxCoeff() <= tolerance * h * g_.cwiseAbs().maxCoeff()) return;
        H_.set_zero();
        limits.add_hessian(trial_, Tangent::definite, H_);
        K_.set_zero();
        K_.add_scaled(A, 1);
        K_.add_scaled(H_, h * h);
        system_.hold(K_, held);
        if (!system_.solver().try_factorize(K_)) throw NumericalError("the matrix of the strain limits is not positive definite");
        system_.solver().solve(r_, d_);
        const double slope = -r_.dot(d_);
        double alpha = 1, next = energy(A, h, dv - d_);
        while (!(next <= now + 1e-4 * alpha * slope) && alpha > 1e-6) {
            alpha /= 2;
            next = energy(A, h, dv - alpha * d_);
        }
        if (!(next < now)) return;           // at rounding: the multipliers' gap decides
        dv -= alpha * d_;
        now = next;
    }
}

}  // namespace arcsim
