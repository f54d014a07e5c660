#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formwork/equilibrium/measure.hpp"
#include "formwork/equilibrium/method.hpp"

namespace formwork {

/// One search for an equilibrium: the system, its solver and the phases it goes through. Coarser meshes run inside it.
class Run {
public:
    explicit Run(const EquilibriumProblem& p);

    /// @throws EquilibriumError, InputError
    EquilibriumResult find();

private:
    /// How far a run goes: what is asked for, or only as far as a finer mesh needs its start.
    struct Goal {
        double tolerance;
        double allowed_effect;   // of the regularisation on depth and volume
    };

    double accuracy() const;
    bool is_newton() const { return p_.solver.method == SolverMethod::static_newton; }
    void check();
    void leave_trivial_branch();
    void approach(const Goal& goal);
    /// Starts from the shape on a mesh of a quarter of the nodes. @returns false: not worth it, or the coarse run failed
    bool start_from_coarse_mesh();
    void start_afresh();
    void solve_or_throw(double tolerance, double T0, const std::string& phase);
    SolveOutcome solve_with_level(double tolerance, double T0, const std::string& phase);

    // run_tension_field.cpp
    void solve_tension_field(const Goal& goal);
    bool finish_without_prestress(double tolerance);
    bool approach_from_full(double tolerance, double prestress);
    void lower_prestress(const Goal& goal);
    void estimate_effect();
    void estimate_from(const Extent& before, double less);
    void estimate_from_above();
    void set_effect(const Extent& here, const Extent& change);
    Regulariser regulariser(double prestress) const;
    double worst_effect() const { return std::max(regularisation_.depth_effect, regularisation_.volume_effect); }

    // run_failure.cpp
    [[noreturn]] void explain_failure();
    EquilibriumError failure(const std::string& text);

    EquilibriumResult result(bool converged);

    const EquilibriumProblem& p_;
    StaticSystem system_;
    std::unique_ptr<EquilibriumMethod> method_;
    VectorXd x_;
    SolveOutcome outcome_;
    Regularisation regularisation_;
    std::vector<std::string> warnings_;
    bool from_coarse_ = false;
    double coarse_prestress_part_ = 0;   // of T*: what the coarse mesh was left with
    int coarse_iterations_ = 0, coarse_factorizations_ = 0;
    double coarse_s_ = 0;                // CPU
};

/// A short number for messages.
std::string short_number(double v);

}  // namespace formwork
