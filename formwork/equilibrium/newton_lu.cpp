#include <algorithm>
#include <cmath>

#include "formwork/equilibrium/newton.hpp"

namespace formwork {

/// d = -(H + border border^T)^-1 g with the whole, unsymmetric H; the border by Sherman and Morrison. T0 is raised until
/// the fabric pulls forward along d, which LU, unlike Cholesky, does not promise
/// (`any_direction`: any that solves the system will do).
bool NewtonSolver::direction_by_lu(double& T0, bool any_direction) {
    constexpr double wake_at = 1e-4;   // of T*
    constexpr int attempts = 12;
    const double start = arcsim::cpu_seconds();
    rhs_ = -g_;
    system_.fixed().clear(rhs_);
    bool found = false;
    for (int attempt = 0; attempt < attempts && !found; ++attempt) {
        if (lu_->try_factorize(H_)) {
            lu_->solve(rhs_, d_);
            if (border_.size() > 0) {
                const VectorXd s = lu_->solve(border_);
                d_ -= border_.dot(d_) / (1 + border_.dot(s)) * s;
            }
            const double pull = d_.dot(rhs_);
            found = std::isfinite(pull) && (any_direction || pull > 0);
        }
        if (found) break;
        const double raised = std::max(10 * T0, wake_at * T_ref_);
        system_.add_laplacian(raised - T0, H_);
        T0 = raised;
    }
    times_.numeric += arcsim::cpu_seconds() - start;
    return found;
}

}  // namespace formwork
