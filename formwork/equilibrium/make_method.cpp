#include "formwork/equilibrium/dynamic_relaxation.hpp"
#include "formwork/equilibrium/newton.hpp"
#include "formwork/equilibrium/projective.hpp"
#include "formwork/equilibrium/time_stepping.hpp"

namespace formwork {

std::unique_ptr<EquilibriumMethod> make_method(StaticSystem& system, const EquilibriumProblem& problem) {
    switch (problem.solver.method) {
        case SolverMethod::static_newton:
            return std::make_unique<NewtonSolver>(system, problem.solver, problem.on_iteration);
        case SolverMethod::backward_euler:
        case SolverMethod::newton_euler:
        case SolverMethod::bdf2: return std::make_unique<TimeStepping>(system, problem);
        case SolverMethod::dynamic_relaxation: return std::make_unique<DynamicRelaxation>(system, problem);
        case SolverMethod::projective: return std::make_unique<ProjectiveMethod>(system, problem);
    }
    return nullptr;
}

}  // namespace formwork
