#include <Eigen/SparseCholesky>

#include "arcsim/base/error.hpp"
#include "arcsim/solve/full_matrix.hpp"
#include "arcsim/solve/solvers.hpp"

namespace arcsim {
namespace {

/// Eigen's LDLT of the symmetric half: slow, plain, and another author's: the oracle of the tests.
class EigenSolver final : public LinearSolver {
public:
    std::string_view name() const override { return "eigen"; }
    void analyze(const BlockPattern& p) override {
        pattern_ = &p;
        analyzed_ = false;
    }
    bool try_factorize(const BlockMatrix& A) override {
        if (pattern_ != &A.pattern()) analyze(A.pattern());
        const Eigen::SparseMatrix<double> M = full_matrix(A, false);
        if (!analyzed_) ldlt_.analyzePattern(M);
        analyzed_ = true;
        ldlt_.factorize(M);
        ++cost_.factorizations;
        int weakest = 0;
        factorized_ = ldlt_.info() == Eigen::Success && ldlt_.vectorD().minCoeff(&weakest) > 0;
        if (!factorized_) {
            const int column = ldlt_.permutationPinv().size() > weakest ? ldlt_.permutationPinv().indices()[weakest] : 0;
            breakdown_ = {pattern_->node_at()[column / 3], column % 3};
        }
        return factorized_;
    }
    void solve(const VectorXd& b, VectorXd& x) const override {
        if (!factorized_) throw NumericalError("eigen: solve without a factorisation");
        x = to_nodes(*pattern_, ldlt_.solve(to_places(*pattern_, b)));
    }

private:
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt_;
    const BlockPattern* pattern_ = nullptr;
    bool analyzed_ = false, factorized_ = false;
};

}  // namespace

std::unique_ptr<LinearSolver> make_eigen_ldlt() { return std::make_unique<EigenSolver>(); }

}  // namespace arcsim
