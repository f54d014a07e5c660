#pragma once

#include "arcsim/solve/cloth_stepper.hpp"

namespace arcsim {

/// Implicit steps that are solved to convergence. With x = x* + h' v the balance
///
///   r(v) = M (v - v*) + h' (g(x, v) + D v) = 0
///
/// is backward Euler with x* = x0, v* = v0, h' = h, and BDF2 with x* = (4 x0 - x1)/3, v* = (4 v0 - v1)/3,
/// h' = 2h/3 (the first step, and the first after a halving, is backward Euler's). g: gradient of all forces,
/// D: stiffness-proportional damping. Nothing lags: bending stiffness and the wind's normal are those of x.
///
/// Newton with K = M + h'² H + h' (D + W), W the wind's derivative by the velocity. H is the exact tangent while K is positive definite; else the
/// definite one. A balance that is not a minimum (a perfectly flat sheet that is pressed together in its plane)
/// is out of reach of both: after some halvings the exact unsymmetric tangent with LU may find it; not before,
/// since it would as well keep a sheet flat that ought to buckle. The tabulated law has no potential, so the line search asks that the residual, or else the correction
/// that the old matrix would make next (natural monotonicity), becomes smaller; the latter does not suffer
/// from the ratio of the stiffnesses.
///
/// Strain limits are part of the balance: rounds of Newton, each with better multipliers (LimitRounds).
///
/// A step fails when the iteration does not converge, a number is not finite, or a face is stretched beyond
/// the limit. It is then halved, the halves again, up to `max_halvings` times; parts grow again once Newton finds them easy.
class ConvergedStepper final : public ClothStepper {
public:
    ConvergedStepper(ClothModel& model, const StepParams& params, FillOrder order);

    StepResult step(State& s, double h) override;
    void restart() override;

private:
    std::vector<double> own_memory() const override;             // h, x, v of one step earlier, for bdf2
    void set_own_memory(const std::vector<double>& memory) override;
    struct Problem {
        VectorXd x, v;      // x*, v*
        double h;           // h'
    };
    void advance(State& s, double h, StepResult& result);
    VectorXd solve(const Problem& p, const State& start, StepResult& result);
    VectorXd balance(const Problem& p, VectorXd v, StepResult& result);   // with the limits' multipliers held
    double residual(const Problem& p, const VectorXd& v, VectorXd& r);   // returns the scale of its forces, N
    enum class Direction { exact, definite, unsymmetric };
    bool factorize(const Problem& p, const VectorXd& v, Direction direction);
    void correction(const VectorXd& r, VectorXd& dv);
    std::vector<Direction> directions() const;
    struct Iterate;
    bool try_direction(const Problem& p, Direction direction, Iterate& now);
    double mass_norm(const VectorXd& dv) const;
    [[noreturn]] void fail(const std::string& why, const VectorXd& x);

    std::unique_ptr<BlockMatrix> viscous_;          // D + W
    std::unique_ptr<BlockMatrix> unsymmetric_;      // made when first needed
    std::unique_ptr<LinearSolver> lu_;
    LinearSolver* solver_ = nullptr;                // that holds the last factorisation
    bool is_damped_;
    int level_ = 0;                                 // of halving, of the part under way
    double size_;                                   // of the cloth, m
    double previous_h_ = 0;                         // 0: no step to build on
    VectorXd previous_x_, previous_v_;
    State trial_;
    VectorXd g_, product_, minus_r_, dv_, dv_next_, v_next_, r_next_;
    std::vector<Vector3d> zeros_;
};

}  // namespace arcsim
