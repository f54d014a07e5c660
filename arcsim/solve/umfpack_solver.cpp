#include <umfpack.h>

#include <string>

#include "arcsim/base/error.hpp"
#include "arcsim/solve/full_matrix.hpp"
#include "arcsim/solve/solvers.hpp"

namespace arcsim {
namespace {

/// Sparse LU of the whole, unsymmetric matrix.
class UmfpackSolver final : public LinearSolver {
public:
    UmfpackSolver() {
        umfpack_di_defaults(control_);
        control_[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;   // the pattern is symmetric, the diagonal strong
    }
    ~UmfpackSolver() override { release(); }
    UmfpackSolver(const UmfpackSolver&) = delete;
    UmfpackSolver& operator=(const UmfpackSolver&) = delete;

    std::string_view name() const override { return "umfpack"; }

    void analyze(const BlockPattern& p) override {
        release();
        pattern_ = &p;                                              // the symbolic analysis wants the first matrix
    }

    bool try_factorize(const BlockMatrix& A) override {
        if (pattern_ != &A.pattern()) analyze(A.pattern());
        const double start = cpu_seconds();
        M_ = full_matrix(A, true);
        const int n = pattern_->n_dofs();
        if (!symbolic_ && umfpack_di_symbolic(n, n, M_.outerIndexPtr(), M_.innerIndexPtr(), M_.valuePtr(), &symbolic_,
                                              control_, nullptr) != UMFPACK_OK)
            throw NumericalError("umfpack: the analysis of " + std::to_string(n) + " equations failed");
        if (numeric_) umfpack_di_free_numeric(&numeric_);
        const int status = umfpack_di_numeric(M_.outerIndexPtr(), M_.innerIndexPtr(), M_.valuePtr(), symbolic_,
                                              &numeric_, control_, nullptr);
        ++cost_.factorizations;
        cost_.numeric_s += cpu_seconds() - start;
        if (status == UMFPACK_ERROR_out_of_memory) throw NumericalError("umfpack: out of memory");
        factorized_ = status == UMFPACK_OK;
        if (!factorized_) breakdown_ = empty_row();
        return factorized_;
    }

    void solve(const VectorXd& b, VectorXd& x) const override {
        if (!factorized_) throw NumericalError("umfpack: solve without a factorisation");
        const VectorXd rhs = to_places(*pattern_, b);
        VectorXd out(rhs.size());
        if (umfpack_di_solve(UMFPACK_A, M_.outerIndexPtr(), M_.innerIndexPtr(), M_.valuePtr(), out.data(), rhs.data(),
                             numeric_, control_, nullptr) != UMFPACK_OK)
            throw NumericalError("umfpack: the solve failed");
        x = to_nodes(*pattern_, out);
    }

private:
    /// The node with the weakest column: where a singular matrix most likely lost its rank.
    Breakdown empty_row() const {
        int weakest = 0;
        double smallest = 1e300;
        for (int c = 0; c < M_.outerSize(); ++c) {
            const double size = M_.col(c).norm();
            if (size < smallest) smallest = size, weakest = c;
        }
        return {pattern_->node_at()[weakest / 3], weakest % 3};
    }
    void release() {
        if (numeric_) umfpack_di_free_numeric(&numeric_);
        if (symbolic_) umfpack_di_free_symbolic(&symbolic_);
        factorized_ = false;
    }

    double control_[UMFPACK_CONTROL];
    void *symbolic_ = nullptr, *numeric_ = nullptr;
    Eigen::SparseMatrix<double> M_;
    const BlockPattern* pattern_ = nullptr;
    bool factorized_ = false;
};

}  // namespace

std::unique_ptr<LinearSolver> make_umfpack() { return std::make_unique<UmfpackSolver>(); }

}  // namespace arcsim
