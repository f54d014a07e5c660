#include <algorithm>
#include <cmath>

#include "formwork/equilibrium/newton.hpp"

namespace formwork {
namespace {

constexpr int gmres_limit = 100;         // beyond, an LU factorisation is cheaper
constexpr int gmres_refactor_next = 8;   // beyond, the next step gets a new factor; with a new one 1 to 5 are usual
constexpr double pull_back_at = 1e-4;         // of T*: the first T0 tried where the fabric pulls back
constexpr int attempts = 12;

}  // namespace

/// d = -(H + border border^T)^-1 g with the whole, unsymmetric H. T0 is raised until the fabric pulls forward along d,
/// which an unsymmetric solve, unlike Cholesky, does not promise (`any_direction`: any that solves the system will do).
bool NewtonSolver::direction_unsymmetric(const VectorXd& x, double& T0, double relative, bool any_direction) {
    rhs_ = -g_;
    system_.fixed().clear(rhs_);
    for (int attempt = 0; attempt < attempts; ++attempt) {
        if (direction_by_gmres(x, T0, relative) || direction_by_lu()) {
            const double pull = d_.dot(rhs_);
            if (std::isfinite(pull) && (any_direction || pull > 0)) return true;
        }
        const double raised = std::max(10 * T0, pull_back_at * T_ref_);
        system_.add_laplacian(raised - T0, H_);
        T0 = raised;
        factor_is_stale_ = true;
    }
    return false;
}

/// The definite tangent, without compression and antisymmetric half, is so near the whole one that GMRES needs a handful of
/// iterations on its factor: a fifth of the price of LU.
bool NewtonSolver::direction_by_gmres(const VectorXd& x, double T0, double relative) {
    const double eta = std::clamp(1e-2 * relative, 1e-4, 1e-2);
    const auto multiply = [&](const VectorXd& v, VectorXd& y) {
        H_.multiply(v, y);
        if (border_.size() > 0) y += border_ * border_.dot(v);
    };
    for (;;) {
        const bool fresh = factor_is_stale_;
        if (fresh && !factorize_definite(x, T0)) return false;
        const double start = arcsim::cpu_seconds();
        const arcsim::GmresOutcome out = gmres_.solve(multiply, factor_.solver(), rhs_, eta, gmres_limit, d_);
        times_.solve += arcsim::cpu_seconds() - start;
        factor_is_stale_ = !out.converged || out.iterations > gmres_refactor_next;
        if (out.converged || fresh) return out.converged;
    }
}

/// The liquid's part is in while the sum stays definite.
bool NewtonSolver::factorize_definite(const VectorXd& x, double T0) {
    constexpr double without_liquid = 1e-3;   // of T*: the least T0 then
    const double start = arcsim::cpu_seconds();
    if (!definite_) definite_ = std::make_unique<BlockMatrix>(system_.pattern());
    VectorXd border;
    system_.tangent(x, T0, *definite_, border, arcsim::Tangent::definite);
    system_.add_pressure_tangent(*definite_);
    bool ok = factor_.try_factorize(*definite_);
    if (!ok) {
        system_.tangent(x, std::max(T0, without_liquid * T_ref_), *definite_, border, arcsim::Tangent::definite);
        ok = factor_.try_factorize(*definite_);
    }
    times_.numeric += arcsim::cpu_seconds() - start;
    times_.symbolic = factor_.symbolic_s();
    factor_is_stale_ = !ok;
    return ok;
}

/// The border by Sherman and Morrison.
bool NewtonSolver::direction_by_lu() {
    const double start = arcsim::cpu_seconds();
    if (!lu_) {
        lu_ = arcsim::make_linear_solver(arcsim::SolverKind::umfpack);
        lu_->analyze(system_.pattern());
    }
    const bool ok = lu_->try_factorize(H_);
    if (ok) {
        lu_->solve(rhs_, d_);
        if (border_.size() > 0) {
            const VectorXd s = lu_->solve(border_);
            d_ -= border_.dot(d_) / (1 + border_.dot(s)) * s;
        }
    }
    times_.numeric += arcsim::cpu_seconds() - start;
    return ok;
}

}  // namespace formwork
