#include "formwork/equilibrium/tangent_factor.hpp"

#include "arcsim/solve/own_factor.hpp"

namespace formwork {
namespace {

using arcsim::SolverKind;

constexpr int refusals_enough = 3;   // of definite tangents: then single precision is not asked again

SolverKind kind_of(LinearSolverChoice c) {
    switch (c) {
        case LinearSolverChoice::umfpack: return SolverKind::umfpack;
        case LinearSolverChoice::eigen: return SolverKind::eigen_ldlt;
        case LinearSolverChoice::pcg: return SolverKind::pcg;
        case LinearSolverChoice::cholmod: break;
    }
    return SolverKind::cholmod;
}

}  // namespace

TangentFactor::TangentFactor(LinearSolverChoice choice) : double_kind_(kind_of(choice)) {
    if (double_kind_ == SolverKind::cholmod && arcsim::own_factor_is_quick) single_ = arcsim::make_linear_solver(SolverKind::single);
}

void TangentFactor::analyze(const arcsim::BlockPattern& pattern) {
    pattern_ = &pattern;
    if (single_) single_->analyze(pattern);
}

bool TangentFactor::try_factorize(const arcsim::BlockMatrix& H) {
    ++factorizations_;
    if (single_ && single_refused_in_vain_ < refusals_enough && single_->try_factorize(H)) {
        used_ = single_.get();
        return true;
    }
    const bool ok = try_double(H);
    if (ok) ++single_refused_in_vain_;
    return ok;
}

bool TangentFactor::try_double(const arcsim::BlockMatrix& H) {
    if (!double_) {
        double_ = arcsim::make_linear_solver(double_kind_);
        double_->analyze(*pattern_);
    }
    used_ = double_.get();
    return double_->try_factorize(H);
}

double TangentFactor::symbolic_s() const {
    return (single_ ? single_->cost().symbolic_s : 0) + (double_ ? double_->cost().symbolic_s : 0);
}

}  // namespace formwork
