#pragma once

#include <string>

#include "formwork/equilibrium/step_matrix.hpp"

namespace formwork {

/// The bag on its way: positions, velocities and forces at one time.
struct Motion {
    VectorXd x, v;                     // m, m/s; 3n
    VectorXd g;                        // -(sum of all forces) at x, N
    StaticSystem::Balance balance;     // of g
};

/// One way to advance in time. A step that fails leaves its message in `why` and `next` undefined.
class TimeStep {
public:
    virtual ~TimeStep() = default;
    /// @param now   motion at the start of the step
    /// @param next  x and v after it; g and balance are the caller's to fill
    /// @param floor force below which a converged step need not go, N
    virtual bool take(const Motion& now, double h, double floor, Motion& next, std::string& why) = 0;
    /// Newton iterations of the last step.
    virtual int iterations() const { return 1; }
    /// Forgets earlier steps: the next one stands alone.
    virtual void restart() {}
};

/// Backward Euler, linearised once from the current state (SYSTEM row 10):
///
///   A dv = b,   A = M - h (h + beta) J_fabric - h² J_other,   b = h f + h (h + beta) J_fabric v + h² J_other v
///
/// solved as A (v + dv) = M v + h f, which is the same.
class LinearisedEuler final : public TimeStep {
public:
    LinearisedEuler(StepMatrix& matrix, double damping) : matrix_(matrix), damping_(damping) {}
    bool take(const Motion& now, double h, double floor, Motion& next, std::string& why) override;

private:
    StepMatrix& matrix_;
    double damping_;   // beta, s
    VectorXd rhs_;
};

/// Implicit steps solved to convergence. With x = x* + h' v the balance
///
///   r(v) = M (v - v*) / h' + g(x) + beta H_fabric v = 0
///
/// (H_fabric where the step starts, or is predicted to end) is backward Euler with x* = x0, v* = v0, h' = h, and BDF2 with x* = (4 x0 - x1)/3, v* = (4 v0 - v1)/3, h' = 2h/3 (the
/// first step, and the first of another length, is backward Euler's). It is the gradient of the incremental potential
/// ½ |x - x* - h' v*|²_M / h'² + ½ beta |x - x*|²_H / h' + E(x): Newton's step is halved until the balance along it no longer
/// pulls back by more than half, which needs no potential and finds the same minimum.
class ConvergedStep final : public TimeStep {
public:
    ConvergedStep(StaticSystem& system, StepMatrix& matrix, double damping, bool second_order, double precision);
    bool take(const Motion& now, double h, double floor, Motion& next, std::string& why) override;
    int iterations() const override { return iterations_; }
    void restart() override { previous_h_ = 0; }

private:
    double residual(const VectorXd& v, VectorXd& r);
    bool improve(VectorXd& v, std::string& why);

    StaticSystem& system_;
    StepMatrix& matrix_;
    double damping_, precision_;   // beta, s; of the balance, relative to the forces at the start of the step
    bool second_order_;
    int iterations_ = 0;
    double h_ = 0;                 // h'
    VectorXd from_, carried_;      // x*, v*
    double previous_h_ = 0;        // 0: no step to build on
    VectorXd previous_x_, previous_v_;
    std::unique_ptr<BlockMatrix> damper_;   // H_fabric, when damped
    VectorXd x_, r_, trial_r_, dv_, trial_, product_;
    double now_ = 0;               // |r_| over free dofs
};

}  // namespace formwork
