#pragma once

#include <memory>

#include "arcsim/solve/supernodal_factor.hpp"

namespace arcsim {

/// Cholesky by SupernodalFactor. In double precision a direct solver; in single precision ("single") its solution
/// carries 4 to 6 digits, for half the memory and time: a preconditioner, for FactorPcg.
///
/// A single-precision factorisation cannot tell a small positive pivot from a negative one: it refuses
/// those below `least_pivot_single` of their diagonal entry. It may also pass a matrix with a slightly negative
/// eigenvalue; conjugate gradients then meet negative curvature.
template <class Real>
class SupernodalSolver final : public LinearSolver {
public:
    std::string_view name() const override { return sizeof(Real) == 4 ? "single" : "supernodal"; }
    void analyze(const BlockPattern& pattern) override;
    /// With a shape that another solver of the same pattern has found.
    void analyze(const BlockPattern& pattern, std::shared_ptr<const Supernodes> shape);
    bool try_factorize(const BlockMatrix& A) override;
    void solve(const VectorXd& b, VectorXd& x) const override;
    using LinearSolver::solve;

private:
    const BlockPattern* pattern_ = nullptr;
    std::unique_ptr<SupernodalFactor<Real>> factor_;
    std::vector<int> node_at_;             // of each position
    mutable std::vector<Real> work_;
    bool factorized_ = false;
};

extern template class SupernodalSolver<float>;
extern template class SupernodalSolver<double>;

}  // namespace arcsim
