#include <Eigen/IterativeLinearSolvers>
#include <random>

#include "arcsim/base/error.hpp"
#include "arcsim/solve/full_matrix.hpp"
#include "arcsim/solve/pcg.hpp"
#include "arcsim/solve/solvers.hpp"

namespace arcsim {
namespace {

/// Eigen's incomplete Cholesky factor (Lin and Moré's, shifted where a pivot fails) as a preconditioner.
class IncompleteFactor final : public LinearSolver {
public:
    std::string_view name() const override { return "incomplete Cholesky"; }
    void analyze(const BlockPattern& p) override { pattern_ = &p; }
    bool try_factorize(const BlockMatrix& A) override {
        pattern_ = &A.pattern();
        factor_.compute(full_matrix(A, false));
        return factor_.info() == Eigen::Success;
    }
    void solve(const VectorXd& b, VectorXd& x) const override { x = to_nodes(*pattern_, factor_.solve(to_places(*pattern_, b))); }

private:
    Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::AMDOrdering<int>> factor_;
    const BlockPattern* pattern_ = nullptr;
};

/// Conjugate gradients on an incomplete factor: as little memory as a solver can do with, and time that grows with
/// the square root of the matrix's condition. It meets negative curvature only while it solves, so a factorisation
/// ends with one solve for a fixed random vector, which is likely to find it.
class PcgSolver final : public LinearSolver {
public:
    std::string_view name() const override { return "pcg"; }
    void analyze(const BlockPattern& p) override { incomplete_.analyze(p); }

    /// Keeps a reference to A, which must not change until the last solve.
    bool try_factorize(const BlockMatrix& A) override {
        A_ = &A;
        ++cost_.factorizations;
        if (incomplete_.try_factorize(A) && is_likely_definite()) return true;
        A_ = nullptr;
        return false;
    }

    void solve(const VectorXd& b, VectorXd& x) const override {
        if (!A_) throw NumericalError("pcg: solve without a factorisation");
        const PcgOutcome outcome = run(b, tolerance, x);
        if (outcome.status == PcgStatus::out_of_iterations)
            throw NumericalError("pcg: conjugate gradients did not converge in " + std::to_string(outcome.iterations) +
                                 " iterations. Use another linear_solver");
    }

private:
    static constexpr double tolerance = 1e-10, probe_tolerance = 1e-2;
    static constexpr int most_iterations = 20000;

    PcgOutcome run(const VectorXd& b, double to, VectorXd& x) const {
        return pcg_.solve([this](const VectorXd& p, VectorXd& Ap) { A_->multiply_symmetric(p, Ap); }, incomplete_, b, to, most_iterations, x);
    }
    bool is_likely_definite() {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> uniform(-1, 1);
        const VectorXd b = VectorXd::NullaryExpr(A_->pattern().n_dofs(), [&] { return uniform(random); });
        VectorXd x;
        if (run(b, probe_tolerance, x).status != PcgStatus::negative_curvature) return true;
        Eigen::Index weakest = 0;
        A_->diagonal().minCoeff(&weakest);
        breakdown_ = {static_cast<int>(weakest) / 3, static_cast<int>(weakest) % 3};
        return false;
    }

    IncompleteFactor incomplete_;
    const BlockMatrix* A_ = nullptr;
    mutable FactorPcg pcg_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_pcg() { return std::make_unique<PcgSolver>(); }

}  // namespace arcsim
