#include "arcsim/solve/pcg.hpp"

#include <cmath>

namespace arcsim {

PcgOutcome FactorPcg::solve(const std::function<void(const VectorXd&, VectorXd&)>& multiply,
                            const LinearSolver& factor, const VectorXd& b, double tolerance, int max_iterations,
                            VectorXd& x) {
    x.setZero(b.size());
    r_ = b;
    factor.solve(r_, z_);
    p_ = z_;
    double rz = r_.dot(z_);
    const double target = tolerance * tolerance * rz;
    if (!(rz > 0)) return {PcgStatus::converged, 0};
    for (int i = 1; i <= max_iterations; ++i) {
        multiply(p_, Ap_);
        const double curvature = p_.dot(Ap_);
        if (!(curvature > 0)) {
            if (i == 1) x = z_;
            return {PcgStatus::negative_curvature, i};
        }
        const double alpha = rz / curvature;
        x += alpha * p_;
        r_ -= alpha * Ap_;
        factor.solve(r_, z_);
        const double next = r_.dot(z_);
        if (next <= target) return {PcgStatus::converged, i};
        p_ = z_ + (next / rz) * p_;
        rz = next;
    }
    return {PcgStatus::out_of_iterations, max_iterations};
}

}  // namespace arcsim
