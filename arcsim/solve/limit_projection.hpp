#pragma once

#include "arcsim/solve/cloth_system.hpp"

namespace arcsim {

/// Brings the end of a linearised step inside the strain limits. The step's own equation gains the limits'
/// stress, taken at the new positions: with A the step's matrix,
///
///   A dv + h g(x + h dv) = 0,   0 ≼ multipliers ⊥ bounds - strain ≽ 0
///
/// the least change of the velocities, in the norm of A, that satisfies the limits. Held nodes stay; springs of
/// handles and the fabric resist as they do in the step. Momentum: g sums to zero.
class LimitProjection {
public:
    explicit LimitProjection(ClothSystem& system);

    /// Changes x and v. @param A  of the step, held rows fixed
    /// @throws NumericalError: the limits cannot be met
    void apply(const BlockMatrix& A, double h, VectorXd& x, VectorXd& v);

private:
    double energy(const BlockMatrix& A, double h, const VectorXd& dv);
    void minimise(const BlockMatrix& A, double h, VectorXd& dv);

    ClothSystem& system_;
    BlockMatrix K_, H_;
    State trial_;
    VectorXd start_, Adv_, g_, r_, d_;
};

}  // namespace arcsim
