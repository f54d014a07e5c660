#include <cholmod.h>
#include <omp.h>

#include <algorithm>
#include <string>

#include "arcsim/base/error.hpp"
#include "arcsim/solve/solvers.hpp"

namespace arcsim {
namespace {

/// CHOLMOD asks for four OpenMP threads in loops of microseconds, whatever OMP_NUM_THREADS says; waiting for
/// them doubles the time of a factorisation (measured). Within this scope they run on the calling thread.
class NoNestedThreads {
public:
    NoNestedThreads() : levels_(omp_get_max_active_levels()) { omp_set_max_active_levels(0); }
    ~NoNestedThreads() { omp_set_max_active_levels(levels_); }
    NoNestedThreads(const NoNestedThreads&) = delete;
    NoNestedThreads& operator=(const NoNestedThreads&) = delete;

private:
    int levels_;
};

/// Supernodal Cholesky. The pattern already stands in fill order, so CHOLMOD is told to keep it: it then
/// reads our arrays where they are, without a permuted copy.
class CholmodSolver final : public LinearSolver {
public:
    CholmodSolver() {
        cholmod_start(&common_);
        common_.print = 0;
        common_.nmethods = 1;
        common_.method[0].ordering = CHOLMOD_NATURAL;
        common_.postorder = 0;
        common_.final_ll = 1;
        common_.quick_return_if_not_posdef = 1;
    }
    ~CholmodSolver() override {
        release();
        cholmod_free_dense(&x_, &common_);
        cholmod_free_dense(&y_, &common_);
        cholmod_free_dense(&e_, &common_);
        cholmod_finish(&common_);
    }
    CholmodSolver(const CholmodSolver&) = delete;
    CholmodSolver& operator=(const CholmodSolver&) = delete;

    std::string_view name() const override { return "cholmod"; }

    void analyze(const BlockPattern& p) override {
        const double start = cpu_seconds();
        release();
        pattern_ = &p;
        cholmod_sparse A = view(p, nullptr);
        L_ = cholmod_analyze(&A, &common_);
        if (!L_ || common_.status < 0)
            throw NumericalError("cholmod: the analysis of " + std::to_string(p.n_dofs()) +
                                 " equations failed: out of memory or too large");
        cost_.nonzeros = common_.lnz;
        cost_.flops = common_.fl;
        b_.resize(p.n_dofs());
        cost_.symbolic_s += cpu_seconds() - start;
    }

    bool try_factorize(const BlockMatrix& A) override {
        if (pattern_ != &A.pattern()) analyze(A.pattern());
        const double start = cpu_seconds();
        const NoNestedThreads serial;
        cholmod_sparse view_of_A = view(A.pattern(), const_cast<double*>(A.values()));
        cholmod_factorize(&view_of_A, L_, &common_);
        ++cost_.factorizations;
        cost_.numeric_s += cpu_seconds() - start;
        if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw NumericalError("cholmod: out of memory");
        factorized_ = common_.status == CHOLMOD_OK && L_->minor == L_->n;
        if (!factorized_) {
            const int column = static_cast<int>(std::min<std::size_t>(L_->minor, L_->n - 1));
            breakdown_ = {pattern_->node_at()[column / 3], column % 3};
        }
        return factorized_;
    }

    void solve(const VectorXd& b, VectorXd& x) const override {
        if (!factorized_) throw NumericalError("cholmod: solve without a factorisation");
        const NoNestedThreads serial;
        const auto& node = pattern_->node_at();
        const int n = pattern_->n_nodes();
        for (int p = 0; p < n; ++p) b_.segment<3>(3 * p) = b.segment<3>(3 * node[p]);
        cholmod_dense B{};
        B.nrow = B.nzmax = B.d = static_cast<std::size_t>(b_.size());
        B.ncol = 1;
        B.x = b_.data();
        B.xtype = CHOLMOD_REAL;
        cholmod_solve2(CHOLMOD_A, L_, &B, nullptr, &x_, nullptr, &y_, &e_, &common_);
        if (common_.status < 0) throw NumericalError("cholmod: the solve failed");
        x.resize(b.size());
        const double* out = static_cast<const double*>(x_->x);
        for (int p = 0; p < n; ++p)
            for (int c = 0; c < 3; ++c) x[3 * node[p] + c] = out[3 * p + c];
    }

private:
    static cholmod_sparse view(const BlockPattern& p, double* values) {
        cholmod_sparse A{};
        A.nrow = A.ncol = static_cast<std::size_t>(p.n_dofs());
        A.nzmax = static_cast<std::size_t>(p.n_values());
        A.p = const_cast<int*>(p.col_ptr().data());
        A.i = const_cast<int*>(p.row_index().data());
        A.x = values;
        A.stype = -1;
        A.itype = CHOLMOD_INT;
        A.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
        A.sorted = A.packed = 1;
        return A;
    }
    void release() {
        if (L_) cholmod_free_factor(&L_, &common_);
        factorized_ = false;
    }

    mutable cholmod_common common_{};
    mutable cholmod_factor* L_ = nullptr;
    mutable cholmod_dense *x_ = nullptr, *y_ = nullptr, *e_ = nullptr;   // workspaces that live between solves
    mutable VectorXd b_;
    const BlockPattern* pattern_ = nullptr;
    bool factorized_ = false;
};

}  // namespace

std::unique_ptr<LinearSolver> make_cholmod() { return std::make_unique<CholmodSolver>(); }

}  // namespace arcsim
