#pragma once

#include <memory>

#include "arcsim/solve/linear_solver.hpp"
#include "formwork/equilibrium/solver_params.hpp"

namespace formwork {

/// The factor that preconditions Newton's conjugate gradients. It need not be exact, so a single-precision one is tried
/// first: half the memory and solve, a quarter of the factorisation. It cannot tell a small pivot from a negative one;
/// where it refuses, a double-precision factor judges whether the tangent is positive definite, and stays in use for that
/// matrix.
class TangentFactor {
public:
    explicit TangentFactor(LinearSolverChoice choice);

    void analyze(const arcsim::BlockPattern& pattern);
    bool try_factorize(const arcsim::BlockMatrix& H);
    const arcsim::LinearSolver& solver() const { return *used_; }
    /// Single and double precision for one matrix count once.
    int factorizations() const { return factorizations_; }
    double symbolic_s() const;

private:
    bool try_double(const arcsim::BlockMatrix& H);

    std::unique_ptr<arcsim::LinearSolver> single_, double_;
    arcsim::SolverKind double_kind_;
    const arcsim::LinearSolver* used_ = nullptr;
    const arcsim::BlockPattern* pattern_ = nullptr;
    int factorizations_ = 0, single_refused_in_vain_ = 0;
};

}  // namespace formwork
