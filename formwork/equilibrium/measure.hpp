#pragma once

#include "formwork/equilibrium/static_system.hpp"

namespace formwork {

/// Everything that is read off a shape, converged or not: depths, volumes, support, strain field.
void measure(const EquilibriumProblem& p, StaticSystem& system, const VectorXd& x, EquilibriumResult& r);

/// Faces that carry tension one way, and none.
struct WrinkleCount {
    int wrinkled = 0, slack = 0;
    int sum() const { return wrinkled + slack; }
};
WrinkleCount count_wrinkles(const MembraneForce& membrane, const VectorXd& x);

/// Depth of the lowest point below the level (without liquid: how far the bag reaches below or above the held nodes) and
/// volume of liquid (without liquid: the capacity).
struct Extent {
    double depth = 0, volume = 0;
};
Extent measure_extent(StaticSystem& system, const VectorXd& x);

}  // namespace formwork
