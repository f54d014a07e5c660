#include "arcsim/solve/supernodal_solver.hpp"

#include "arcsim/base/error.hpp"
#include "arcsim/solve/solvers.hpp"

namespace arcsim {
namespace {

constexpr double least_pivot_single = 1e-6;   // of the diagonal: some 16 units in the last place
constexpr double least_pivot_double = 0;

}  // namespace

template <class Real>
void SupernodalSolver<Real>::analyze(const BlockPattern& pattern) {
    const double start = cpu_seconds();
    auto shape = std::make_shared<const Supernodes>(pattern);
    cost_.symbolic_s += cpu_seconds() - start;
    analyze(pattern, std::move(shape));
}

template <class Real>
void SupernodalSolver<Real>::analyze(const BlockPattern& pattern, std::shared_ptr<const Supernodes> shape) {
    const double start = cpu_seconds();
    pattern_ = &pattern;
    factorized_ = false;
    cost_.nonzeros = shape->nonzeros();
    cost_.flops = shape->flops();
    node_at_.resize(pattern.n_nodes());
    for (int place = 0; place < pattern.n_nodes(); ++place)
        node_at_[shape->position()[place]] = pattern.node_at()[place];
    work_.resize(pattern.n_dofs());
    factor_ = std::make_unique<SupernodalFactor<Real>>(std::move(shape), pattern);
    cost_.symbolic_s += cpu_seconds() - start;
}

template <class Real>
bool SupernodalSolver<Real>::try_factorize(const BlockMatrix& A) {
    if (pattern_ != &A.pattern()) analyze(A.pattern());
    const double start = cpu_seconds();
    const int failed = factor_->factorize(A, static_cast<Real>(sizeof(Real) == 4 ? least_pivot_single : least_pivot_double));
    ++cost_.factorizations;
    cost_.numeric_s += cpu_seconds() - start;
    factorized_ = failed < 0;
    if (!factorized_) breakdown_ = {node_at_[failed / 3], failed % 3};
    return factorized_;
}

template <class Real>
void SupernodalSolver<Real>::solve(const VectorXd& b, VectorXd& x) const {
    if (!factorized_) throw NumericalError(std::string(name()) + ": solve without a factorisation");
    const double size = b.lpNorm<Eigen::Infinity>();   // keeps small residuals away from the float's underflow
    x.setZero(b.size());
    if (!(size > 0)) return;
    const int n = static_cast<int>(node_at_.size());
    for (int p = 0; p < n; ++p)
        for (int c = 0; c < 3; ++c) work_[3 * p + c] = static_cast<Real>(b[3 * node_at_[p] + c] / size);
    factor_->solve(work_.data());
    for (int p = 0; p < n; ++p)
        for (int c = 0; c < 3; ++c) x[3 * node_at_[p] + c] = size * static_cast<double>(work_[3 * p + c]);
}

template class SupernodalSolver<float>;
template class SupernodalSolver<double>;

std::unique_ptr<LinearSolver> make_supernodal() { return std::make_unique<SupernodalSolver<double>>(); }
std::unique_ptr<LinearSolver> make_single() { return std::make_unique<SupernodalSolver<float>>(); }

}  // namespace arcsim
