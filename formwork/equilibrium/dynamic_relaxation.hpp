#pragma once

#include "formwork/equilibrium/iterative_method.hpp"

namespace formwork {

/// Dynamic relaxation with kinetic damping [Day 1965; Barnes 1999]: explicit steps of length 1 with made-up masses, no
/// matrix to solve. Whenever the kinetic energy passes a peak, the motion is stopped and starts again from the peak.
///
/// A node's mass is half the largest absolute row sum of its part of the tangent: the step then is stable by Gershgorin,
/// with a margin of two in stiffness. Masses are renewed at peaks. A step that fails goes back to the last peak with masses
/// twice as large.
///
/// Works without any factorisation: lean in memory, quick to a rough answer on soft fabric, slow to a good one, slower
/// with every node along the bag and every power of ten in stiffness.
class DynamicRelaxation final : public IterativeMethod {
public:
    DynamicRelaxation(StaticSystem& system, const EquilibriumProblem& problem);

    SolveOutcome solve(VectorXd& x, double tolerance, double T0, const std::string& phase) override;
    int factorizations() const override { return 0; }

private:
    void renew_masses(const VectorXd& x);

    BlockMatrix H_;
    VectorXd border_, row_sum_, mass_;   // 3n
    double margin_ = 1;
};

/// Sum of the absolute values of each row of the symmetric half of A, 3n, by node numbers.
VectorXd absolute_row_sums(const BlockMatrix& A);

}  // namespace formwork
