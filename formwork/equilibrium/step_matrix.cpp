#include "formwork/equilibrium/step_matrix.hpp"

namespace formwork {

using arcsim::SolverKind;
using arcsim::Tangent;

namespace {

SolverKind solver_for(const EquilibriumProblem& p, const StaticSystem& s) {
    if (p.solver.linear_solver == LinearSolverChoice::umfpack || s.membrane().law().is_strongly_unsymmetric())
        return SolverKind::umfpack;
    switch (p.solver.linear_solver) {
        case LinearSolverChoice::eigen: return SolverKind::eigen_ldlt;
        case LinearSolverChoice::pcg: return SolverKind::pcg;
        default: return SolverKind::cholmod;
    }
}

VectorXd lumped_mass(const EquilibriumProblem& p, const MembraneForce& membrane) {
    VectorXd m = VectorXd::Zero(3 * p.rest.n_nodes());
    for (int f = 0; f < p.rest.n_faces(); ++f)
        for (const int node : p.rest.faces[f])
            m.segment<3>(3 * node).array() += p.fabric_density * membrane.rest_area(f) / 3;
    return m;
}

}  // namespace

StepMatrix::StepMatrix(StaticSystem& system, const EquilibriumProblem& problem)
    : system_(system), solver_(arcsim::make_linear_solver(solver_for(problem, system))),
      A_(system.pattern(), solver_for(problem, system) == SolverKind::umfpack ? BlockMatrix::Kind::general
                                                                              : BlockMatrix::Kind::symmetric),
      mass_(lumped_mass(problem, system.membrane())) {
    if (!(problem.fabric_density > 0))
        throw arcsim::InputError("the methods in time need a fabric with mass. Give /formwork/inflate/density (kg/m²), or "
                                 "use the method \"static\" or \"dynamic_relaxation\"");
    solver_->analyze(system.pattern());
}

bool StepMatrix::factorize(const VectorXd& x, double w_fabric, double w_other, const BlockMatrix* damper,
                           double w_damper) {
    for (const Tangent kind : {Tangent::exact, Tangent::definite}) {
        const double start = arcsim::cpu_seconds();
        system_.weighted_tangent(x, w_fabric, w_other, kind, A_, border_);
        if (damper) A_.add_scaled(*damper, w_damper);
        for (int i = 0; i < system_.pattern().n_nodes(); ++i) A_.add_to_diagonal(i, mass_[3 * i]);
        A_.fix(system_.fixed());
        assembly_s_ += arcsim::cpu_seconds() - start;
        if (!solver_->try_factorize(A_)) continue;
        if (border_.size() > 0) solver_->solve(border_, bordered_);
        return true;
    }
    return false;
}

void StepMatrix::solve(const VectorXd& rhs, VectorXd& d) {
    const double start = arcsim::cpu_seconds();
    rhs_ = rhs;
    system_.fixed().clear(rhs_);
    solver_->solve(rhs_, d);
    if (border_.size() > 0) d -= border_.dot(d) / (1 + border_.dot(bordered_)) * bordered_;   // Sherman and Morrison
    solve_s_ += arcsim::cpu_seconds() - start;
}

}  // namespace formwork
