#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "formwork/equilibrium/static_system.hpp"

namespace formwork {

enum class SolveStatus { converged, rounding_floor, runaway, stalled, out_of_iterations };

struct SolveOutcome {
    SolveStatus status = SolveStatus::out_of_iterations;
    double residual = 0;         // relative
    double rounding_floor = 0;   // estimate, relative
    std::string reason;          // of a failure, when the method knows more than its status says
    bool ok() const { return status == SolveStatus::converged || status == SolveStatus::rounding_floor; }
};

/// A largest stretch far beyond any table: a bag that large has no equilibrium.
inline constexpr double runaway_stretch = 12;

/// A way from a start to the shape in which all forces balance. Every method ends by the force residual, never by a
/// velocity or a step: what is slow is not yet at rest (STABILITY row 18).
class EquilibriumMethod {
public:
    virtual ~EquilibriumMethod() = default;

    /// @param x    start and result; when not ok, the best state found
    /// @param T0   initial regularisation of methods that take one, N/m; 0 near a solution
    virtual SolveOutcome solve(VectorXd& x, double tolerance, double T0, const std::string& phase) = 0;

    /// y = -K(x)^-1 g: where the shape goes, to first order, when the gradient changes by g; the level of a prescribed
    /// volume follows.
    /// @returns false when K is not definite: the equilibrium is not a stable one
    virtual bool response(const VectorXd& x, const VectorXd& g, VectorXd& y) = 0;

    virtual int iterations() const = 0;
    virtual int factorizations() const = 0;
    virtual const std::vector<IterationReport>& history() const = 0;
    virtual const SolverTimes& times() const = 0;
    virtual void allow_iterations(int more) = 0;   // beyond those spent so far
};

/// The method that `problem.solver` names.
/// @throws InputError: a method in time for a fabric without mass
std::unique_ptr<EquilibriumMethod> make_method(StaticSystem& system, const EquilibriumProblem& problem);

}  // namespace formwork
