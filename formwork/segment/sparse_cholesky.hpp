#pragma once

#include <complex>
#include <memory>
#include <vector>

namespace formwork {

/// Lower triangle, column by column, of the matrices of this room: one unknown per face, one entry per pair
/// of neighbours. Row numbers increase within a column; the diagonal comes first.
struct LowerPattern {
    int n = 0;
    std::vector<int> column;   // n + 1 starts
    std::vector<int> row;
};

/// P A Pᵀ = L D Lᵀ by CHOLMOD, for Hermitian positive definite A, real or complex, that share one pattern:
/// the ordering is computed once. One BLAS thread, so that results do not depend on the machine's load.
class SparseCholesky {
public:
    explicit SparseCholesky(const LowerPattern& pattern);                  // orders and analyses
    SparseCholesky(const SparseCholesky& same_pattern, int /*numeric*/);   // shares the ordering
    ~SparseCholesky();
    SparseCholesky(SparseCholesky&&) noexcept;
    SparseCholesky& operator=(SparseCholesky&&) noexcept;

    /// @throws NumericalError   a pivot is not positive
    void factorize(const std::vector<double>& values);
    void factorize(const std::vector<std::complex<double>>& values);

    void solve(std::vector<double>& b) const;                       // b := A⁻¹ b
    void solve(std::vector<std::complex<double>>& b) const;

    /// One entry of a sparse vector.
    struct Entry {
        int index;
        double value;
    };
    /// bᵀ A⁻¹ b for a real factor and a b of few entries. Only the columns between the entries and the root
    /// of the elimination tree are visited: much cheaper than a solve.
    double energy_norm(const std::vector<Entry>& b) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace formwork
