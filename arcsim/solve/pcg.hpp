#pragma once

#include <functional>

#include "arcsim/solve/linear_solver.hpp"

namespace arcsim {

enum class PcgStatus { converged, negative_curvature, out_of_iterations };

struct PcgOutcome {
    PcgStatus status = PcgStatus::out_of_iterations;
    int iterations = 0;
};

/// Conjugate gradients for A x = b with an older factorisation as preconditioner: a Newton step for the price of a few
/// triangular solves. Keeps its work vectors between calls.
class FactorPcg {
public:
    /// @param multiply   y = A x, symmetric
    /// @param tolerance  of |b - A x| in the preconditioner's norm, relative to b's
    /// On negative curvature x holds the iterate before it (the preconditioned b when at once).
    PcgOutcome solve(const std::function<void(const VectorXd&, VectorXd&)>& multiply, const LinearSolver& factor,
                     const VectorXd& b, double tolerance, int max_iterations, VectorXd& x);

private:
    VectorXd r_, z_, p_, Ap_;
};

}  // namespace arcsim
