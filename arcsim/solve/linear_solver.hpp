#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "arcsim/base/block_matrix.hpp"

namespace arcsim {

/// Why a factorisation stopped.
struct Breakdown {
    int node = -1;
    int axis = -1;
};

/// What the last analysis and factorisation cost.
struct FactorCost {
    double symbolic_s = 0, numeric_s = 0;   // CPU seconds, summed over the solver's life
    int factorizations = 0;                 // failed ones included
    double nonzeros = 0, flops = 0;         // of one factor
};

/// Solves A x = b for one BlockMatrix. `umfpack`: both halves; the others: the symmetric half, positive definite.
/// `eigen_ldlt` is the tests' oracle.
class LinearSolver {
public:
    virtual ~LinearSolver() = default;
    virtual std::string_view name() const = 0;
    /// Once per pattern.
    virtual void analyze(const BlockPattern& pattern) = 0;
    /// @returns false when the matrix is not positive definite (or singular): see `breakdown`
    virtual bool try_factorize(const BlockMatrix& A) = 0;
    /// x may not be b. Vectors go by node numbers.
    virtual void solve(const VectorXd& b, VectorXd& x) const = 0;

    /// The same with a guess in x, which iterative solvers start from.
    virtual void improve(const VectorXd& b, VectorXd& x) const { solve(b, x); }

    /// @throws NumericalError naming the node whose pivot failed
    void factorize(const BlockMatrix& A);
    VectorXd solve(const VectorXd& b) const {
        VectorXd x;
        solve(b, x);
        return x;
    }
    const Breakdown& breakdown() const { return breakdown_; }
    const FactorCost& cost() const { return cost_; }

protected:
    Breakdown breakdown_;
    FactorCost cost_;
};

enum class SolverKind {
    cholmod,
    umfpack,
    eigen_ldlt,
    supernodal,   // our own Cholesky
    single,       // the same in single precision: a preconditioner
    mixed,        // conjugate gradients on `single`, to the digits of `cholmod`
    pcg,          // conjugate gradients on an incomplete factor
    automatic     // `mixed` or `cholmod`, whichever is quicker in this build (own_factor.hpp)
};
std::unique_ptr<LinearSolver> make_linear_solver(SolverKind kind);

/// CPU time of this process, seconds.
double cpu_seconds();
/// The processor kernel that OpenBLAS chose; "unknown" with another BLAS.
std::string blas_kernel();
/// Threads of the dense kernels; no effect with another BLAS than OpenBLAS.
void set_blas_threads(int n);

}  // namespace arcsim
