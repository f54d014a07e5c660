#pragma once

#include "arcsim/base/archive.hpp"
#include "arcsim/solve/linear_solver.hpp"

namespace arcsim {

enum class StepMethod {
    backward_euler,   // linearised once per step: ArcSim's
    newton_euler,     // solved to convergence
    bdf2              // second order, solved to convergence
};
enum class StepTangent { definite, exact };

/// How a cloth is stepped through time. All but the method and the linear solver are for the converged methods,
/// except the limit of the stretch, which every method watches when it is given.
struct StepParams {
    StepMethod method = StepMethod::backward_euler;
    StepTangent tangent = StepTangent::exact;
    double tolerance = 1e-6;      // of the residual, relative to the largest force in the balance
    int max_iterations = 30;      // per step
    int max_halvings = 16;        // of a step that fails
    SolverKind linear_solver = SolverKind::automatic;
    std::optional<double> max_stretch;   // a face beyond it means a failed step
};
void visit(Archive& a, StepParams& p);

}  // namespace arcsim
