#pragma once

#include "formwork/equilibrium/coarse_mesh.hpp"
#include "formwork/equilibrium/prolong.hpp"
#include "formwork/equilibrium/static_system.hpp"

namespace formwork {

/// The same bag with fewer nodes, from whose shape the fine one starts.
struct CoarseProblem {
    CoarseMesh mesh;
    EquilibriumProblem problem;
};

/// About a quarter of the nodes; level or volume are those that `system` made of the fill, which the coarse rest shape
/// would read a little differently.
CoarseProblem coarse_problem(const EquilibriumProblem& p, const StaticSystem& system);

/// Positions of the fine nodes from those of the coarse ones; held ones stay where they are.
VectorXd fine_positions(const EquilibriumProblem& p, const CoarseProblem& coarse, const VectorXd& coarse_x,
                        Interpolation interpolation);

}  // namespace formwork
