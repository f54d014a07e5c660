#pragma once

#include <functional>
#include <vector>

#include "arcsim/solve/linear_solver.hpp"

namespace arcsim {

struct GmresOutcome {
    bool converged = false;
    int iterations = 0;
};

/// Generalised minimal residuals for an unsymmetric A x = b, with the factor of a matrix near A as preconditioner on the right:
/// |b - A x| itself is what falls [Saad and Schultz 1986]. No restart. With a single-precision factor x is
/// good to about 1e-7. Keeps its basis between calls.
class FactorGmres {
public:
    /// @param multiply   y = A x
    /// @param tolerance  of |b - A x|, relative to |b|
    /// When it does not converge, x is the best of the space searched.
    GmresOutcome solve(const std::function<void(const VectorXd&, VectorXd&)>& multiply, const LinearSolver& factor,
                       const VectorXd& b, double tolerance, int max_iterations, VectorXd& x);

private:
    std::vector<VectorXd> basis_;
    VectorXd z_, w_;
};

}  // namespace arcsim
