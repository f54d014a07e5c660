#include <algorithm>
#include <cmath>
#include <limits>

#include "arcsim/base/error.hpp"
#include "arcsim/solve/solvers.hpp"

namespace arcsim {
namespace {

// Of the error in the energy norm. The last iteration usually ends far below: on hanging sheets of 101² nodes the result
// is then as far from CHOLMOD's (1e-14 soft, 3e-13 stiff) as CHOLMOD's is from the fully refined one.
constexpr double tolerance = 1e-12;
constexpr int most_iterations = 40;     // 3 to 6 are usual; beyond, a double-precision factor is cheaper

/// A factor in single precision, as preconditioner of conjugate gradients in double precision: the accuracy of
/// CHOLMOD for less than half the time. Where single precision does not suffice, CHOLMOD takes over for that
/// matrix; it alone judges whether a matrix is positive definite.
class MixedSolver final : public LinearSolver {
public:
    MixedSolver() : single_(make_single()) {}
    std::string_view name() const override { return "mixed"; }

    void analyze(const BlockPattern& pattern) override {
        single_->analyze(pattern);
        exact_.reset();
        A_ = nullptr;
        take_cost();
    }

    /// Keeps a reference to A, which must not change until the last solve.
    bool try_factorize(const BlockMatrix& A) override {
        A_ = &A;
        needs_exact_ = !single_->try_factorize(A);
        if (!needs_exact_) inverse_diagonal_ = A.diagonal().cwiseInverse();
        const bool ok = !needs_exact_ || factorize_exactly();
        if (!ok) A_ = nullptr;
        take_cost();
        return ok;
    }

    void solve(const VectorXd& b, VectorXd& x) const override {
        x.setZero(b.size());
        improve(b, x);
    }

    void improve(const VectorXd& b, VectorXd& x) const override {
        if (!A_) throw NumericalError("mixed: solve without a factorisation");
        if (!b.allFinite() || !x.allFinite()) {   // no iteration would end
            x.setConstant(b.size(), std::numeric_limits<double>::quiet_NaN());
            return;
        }
        if (!needs_exact_) {
            if (conjugate_gradients(b, x)) return;
            needs_exact_ = true;
            exact_of_ = nullptr;
        }
        if (exact_of_ != A_) {
            make_exact();
            exact_->factorize(*A_);
            exact_of_ = A_;
        }
        exact_->solve(b, x);
    }

private:
    /// @returns false when they meet negative curvature or need too many iterations. The last residual is not solved for
    /// once more: how far it has fallen beside the one before, in the diagonal's norm, tells the energy's, once it is known
    /// how much slower the energy has fallen so far (the worse the condition, the slower).
    bool conjugate_gradients(const VectorXd& b, VectorXd& x) const {
        constexpr double margin = 0.5;   // of that estimate
        const auto diagonal_norm2 = [&] { return r_.cwiseAbs2().dot(inverse_diagonal_); };
        A_->multiply_symmetric(x, Ap_);
        r_ = b - Ap_;
        single_->solve(r_, z_);
        p_ = z_;
        double energy = r_.dot(z_), size = diagonal_norm2();   // rᵀ A⁻¹ r (nearly) and rᵀ D⁻¹ r
        if (size == 0) return true;
        const double of_solution = b.dot(x) + b.dot(z_);   // xᵀ A x, nearly
        const double target = tolerance * tolerance * (of_solution > 0 ? of_solution : energy);
        double lag = 1;
        if (!std::isfinite(energy)) return false;   // numbers beyond 1e150: their squares overflow
        if (energy <= target) return true;
        for (int i = 0; i < most_iterations; ++i) {
            A_->multiply_symmetric(p_, Ap_);
            const double curvature = p_.dot(Ap_);
            if (!(energy > 0) || !(curvature > 0)) return false;
            const double alpha = energy / curvature;
            x += alpha * p_;
            r_ -= alpha * Ap_;
            const double size_before = size;
            size = diagonal_norm2();
            const double fallen = size / size_before;
            if (lag * energy * fallen <= margin * margin * target) return true;
            single_->solve(r_, z_);
            const double next = r_.dot(z_);
            if (next <= target) return true;
            lag = std::max(lag, next / (energy * fallen));
            p_ = z_ + (next / energy) * p_;
            energy = next;
        }
        return false;
    }
    void make_exact() const {
        if (!exact_) exact_ = make_cholmod();
    }
    bool factorize_exactly() {
        make_exact();
        const bool ok = exact_->try_factorize(*A_);
        exact_of_ = ok ? A_ : nullptr;
        breakdown_ = exact_->breakdown();
        return ok;
    }
    void take_cost() {
        cost_ = single_->cost();
        if (!exact_) return;
        cost_.symbolic_s += exact_->cost().symbolic_s;
        cost_.numeric_s += exact_->cost().numeric_s;
        cost_.factorizations += exact_->cost().factorizations;
    }

    std::unique_ptr<LinearSolver> single_;
    mutable std::unique_ptr<LinearSolver> exact_;   // once it was needed
    const BlockMatrix* A_ = nullptr;
    mutable const BlockMatrix* exact_of_ = nullptr;
    mutable bool needs_exact_ = false;
    VectorXd inverse_diagonal_;
    mutable VectorXd r_, z_, p_, Ap_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_mixed() { return std::make_unique<MixedSolver>(); }

}  // namespace arcsim
