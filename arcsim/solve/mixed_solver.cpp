#include <limits>

#include "arcsim/base/error.hpp"
#include "arcsim/solve/pcg.hpp"
#include "arcsim/solve/solvers.hpp"

namespace arcsim {
namespace {

constexpr double tolerance = 1e-13;     // of the error in the energy norm: nothing of single precision remains
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
        const bool ok = !needs_exact_ || factorize_exactly();
        if (!ok) A_ = nullptr;
        take_cost();
        return ok;
    }

    void solve(const VectorXd& b, VectorXd& x) const override {
        if (!A_) throw NumericalError("mixed: solve without a factorisation");
        if (!b.allFinite()) {   // no iteration would end
            x.setConstant(b.size(), std::numeric_limits<double>::quiet_NaN());
            return;
        }
        if (!needs_exact_) {
            const auto multiply = [this](const VectorXd& v, VectorXd& y) { A_->multiply_symmetric(v, y); };
            const PcgOutcome out = pcg_.solve(multiply, *single_, b, tolerance, most_iterations, x);
            if (out.status == PcgStatus::converged) return;
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
    mutable FactorPcg pcg_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_mixed() { return std::make_unique<MixedSolver>(); }

}  // namespace arcsim
