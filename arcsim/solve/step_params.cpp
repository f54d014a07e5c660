#include "arcsim/solve/step_params.hpp"

namespace arcsim {
namespace {

constexpr std::array method_names{
    EnumName{StepMethod::backward_euler, "backward_euler", "one linear solve per step, as ArcSim"},
    EnumName{StepMethod::newton_euler, "newton_euler", "backward Euler solved to convergence, with line search"},
    EnumName{StepMethod::bdf2, "bdf2", "second order, solved to convergence"}};
constexpr std::array tangent_names{
    EnumName{StepTangent::definite, "definite", "ArcSim's approximate tangent"},
    EnumName{StepTangent::exact, "exact", "full tangent while it can be factorised, otherwise the definite one"}};

constexpr std::array solver_names{
    EnumName{SolverKind::automatic, "automatic", "mixed, or cholmod in a program built for any x86-64 machine, where it is quicker"},
    EnumName{SolverKind::mixed, "mixed", "a factor in single precision, refined to double; the exact one where that fails"},
    EnumName{SolverKind::cholmod, "cholmod", "a factor in double precision"},
    EnumName{SolverKind::pcg, "pcg", "conjugate gradients on an incomplete factor: least memory"}};

}  // namespace

void visit(Archive& a, StepParams& p) {
    a.choice("method", p.method, method_names, "How a time step is solved.");
    a.choice("tangent", p.tangent, tangent_names, "Derivative that newton_euler and bdf2 use.");
    a.choice("linear_solver", p.linear_solver, solver_names, "How the linear equations of a step are solved.");
    a.optional("tolerance", p.tolerance, "", positive,
               "Residual at which a step counts as solved, relative to the largest force of the balance.");
    a.optional("max_iterations", p.max_iterations, "", between(1, 10000), "Newton iterations per step.");
    a.optional("max_halvings", p.max_halvings, "", between(0, 30), "How often a failed step is halved before the run stops.");
    a.optional("max_stretch", p.max_stretch, "", above(1),
               "Stretch of a face beyond which a step counts as failed; null: not watched by backward_euler, 3 for the others.");
}

}  // namespace arcsim
