#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "arcsim/base/types.hpp"

namespace formwork {

/// UMFPACK's LU of a small plane problem, with the transposed solve that an adjoint needs.
class SparseLu {
public:
    SparseLu();
    ~SparseLu();
    SparseLu(SparseLu&&) noexcept;
    /// The pattern is analysed once; later matrices must have the same one.
    /// @returns false when A is singular
    bool factorize(const Eigen::SparseMatrix<double>& A);
    arcsim::VectorXd solve(const arcsim::VectorXd& b) const;              // A x = b
    arcsim::VectorXd solve_transposed(const arcsim::VectorXd& b) const;   // A^T x = b

private:
    arcsim::VectorXd solve(const arcsim::VectorXd& b, int system) const;
    struct Factors;
    std::unique_ptr<Factors> factors_;
};

}  // namespace formwork
