#include <malloc.h>

#include <chrono>
#include <cmath>
#include <sstream>
#include <thread>

#include "arcsim/solve/linear_solver.hpp"
#include "formwork/equilibrium/checks.hpp"
#include "formwork/equilibrium/coarse_problem.hpp"
#include "formwork/equilibrium/run.hpp"

namespace formwork {
namespace {

constexpr double allowed_part = 0.8;           // of the promised accuracy: the regularisation's effect on depth and volume
constexpr double promised_accuracy = 1e-3;     // when no other is asked for
constexpr double mesh_error_times_vertices = 4.5;   // largest relative error of a bag's volume, times vertices (docs/speed_accuracy)
constexpr double coarse_tolerance = 1e-4;      // far below what the mesh's own error leaves on the finer one
constexpr int nested_from = 3000;              // nodes; below, the fine mesh alone is as quick
constexpr int most_cap_raises = 6;             // of R each: a head over the rim beyond that is a mistake
constexpr double units_are_wrong = 100;        // N = rho g R² / k, STABILITY row 16
constexpr double units_are_doubtful = 3;

/// Threads of the factorisation's dense kernels: they pay on large meshes only.
int threads_for(const EquilibriumProblem& p) {
    constexpr int all_from = 40000;   // nodes
    if (p.solver.threads > 0) return p.solver.threads;
    return p.rest.n_nodes() < all_from ? 1 : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

}  // namespace

std::string short_number(double v) {
    std::ostringstream s;
    s.precision(3);
    s << v;
    return s.str();
}

Run::Run(const EquilibriumProblem& p)
    : p_(p), system_(p), method_(make_method(system_, p)), x_(flatten(p.start.empty() ? p.rest.x : p.start)) {}

double Run::accuracy() const { return p_.solver.accuracy.value_or(promised_accuracy); }

EquilibriumResult Run::find() {
    check();
    from_coarse_ = start_from_coarse_mesh();
    if (!from_coarse_) leave_trivial_branch();
    approach({p_.solver.tolerance, allowed_part * accuracy()});
    return result(true);
}

void Run::approach(const Goal& goal) {
    MembraneLaw& law = system_.membrane().law();
    const bool automatic = law.is_tension_field() && !p_.material.prestress && !p_.material.residual && system_.has_load();
    if (automatic) return solve_tension_field(goal);
    Regulariser r;
    if (law.is_tension_field()) r = {p_.material.residual.value_or(0), p_.material.prestress.value_or(0)};
    law.set_regulariser(r);
    solve_or_throw(goal.tolerance, from_coarse_ ? 0 : system_.scales().tension, "final");
}

void Run::check() {
    const double mesh_error = mesh_error_times_vertices / p_.rest.n_nodes();
    if (p_.solver.accuracy && mesh_error > *p_.solver.accuracy)
        warnings_.push_back("accuracy " + short_number(*p_.solver.accuracy) + ": a mesh of " + std::to_string(p_.rest.n_nodes()) +
                            " vertices is itself good to about " + short_number(mesh_error) + " of the volume; refine it to about " +
                            std::to_string(std::lround(mesh_error_times_vertices / *p_.solver.accuracy)) + " vertices");
    const double N = load_number(system_);
    if (N > units_are_wrong)
        throw failure("the load number rho g R² / k is " + short_number(N) + ": this fabric (k = " +
                      short_number(system_.membrane().law().rest_stiffness()) + " N/m) cannot hold a bag of half width " +
                      short_number(system_.scales().radius) + " m. Is the mesh in millimetres or centimetres? Set /formwork/units, "
                      "or check the stiffness (N/m) and the density (kg/m³)");
    if (N > units_are_doubtful)
        warnings_.push_back("load number rho g R² / k = " + short_number(N) +
                            ": beyond about 8 a fabric of constant stiffness balloons without end; check the units");
    const std::vector<std::string> free = free_motions(p_, system_.has_liquid(), p_.self_weight && p_.fabric_density > 0);
    if (!free.empty()) throw failure(free.front());
}

/// A flat sheet at the level of its rim carries no load and has no stiffness out of its plane: an equilibrium, but an
/// unstable one (STABILITY row 9). Blow it up a little, by the pressure that is to come.
void Run::leave_trivial_branch() {
    if (!system_.has_load()) return;
    VectorXd g;
    const auto balance = system_.gradient(x_, g);
    const double expected = system_.scales().pressure * system_.scales().area / std::sqrt(double(x_.size()) / 3);
    if (balance.load > 0.05 * expected) return;
    PressureForce blow(p_.rest.faces, p_.up, 0, system_.scales().pressure, PressureQuadrature::consistent,
                       PressureJacobian::none);
    blow.set_orientation(system_.pressure().orientation());
    VectorXd push = VectorXd::Zero(x_.size()), d;
    State s;
    s.x = x_;
    blow.add_gradient(s, push);
    system_.fixed().clear(push);
    BlockMatrix L(system_.pattern());
    system_.add_laplacian(system_.scales().tension, L);
    const auto solver = arcsim::make_linear_solver(arcsim::SolverKind::cholmod);
    solver->analyze(system_.pattern());
    if (!solver->try_factorize(L)) return;
    solver->solve(push, d);
    // As deep as a membrane of this stiffness sags under that pressure, 0.66 R (p R / k)^(1/3) [Hencky 1915].
    const double tension = system_.scales().tension / system_.membrane().law().rest_stiffness();
    const double depth = 0.66 * system_.scales().radius * std::min(1.0, std::cbrt(tension));
    x_ -= depth / d.lpNorm<Eigen::Infinity>() * d;
}

bool Run::start_from_coarse_mesh() {
    const int n = p_.rest.n_nodes();
    if (!is_newton() || !p_.solver.nested || !p_.seams.empty() || n < nested_from || !system_.has_load()) return false;
    const double start = arcsim::cpu_seconds();
    bool found = false;
    try {
        const CoarseProblem coarse = coarse_problem(p_, system_);
        if (coarse.problem.rest.n_nodes() < n / 2) {
            Run run(coarse.problem);
            run.from_coarse_ = run.start_from_coarse_mesh();
            if (!run.from_coarse_) run.leave_trivial_branch();
            run.approach({std::max(coarse_tolerance, p_.solver.tolerance), allowed_part * accuracy()});
            coarse_prestress_part_ = system_.membrane().law().is_tension_field()
                                         ? run.system_.membrane().law().regulariser().Tp / run.system_.scales().tension
                                         : 0;
            x_ = fine_positions(p_, coarse, run.x_, coarse_prestress_part_ > 0 ? Interpolation::linear : Interpolation::quadratic);
            coarse_iterations_ = run.method_->iterations() + run.coarse_iterations_;
            coarse_factorizations_ = run.method_->factorizations() + run.coarse_factorizations_;
            found = true;
        }
    } catch (const arcsim::NumericalError&) {   // the fine mesh may still do, and words its own failure
    } catch (const arcsim::InputError&) {       // a coarse face without area
    }
    malloc_trim(0);   // what the coarser meshes took goes back, or the finest one's peak would stand on top of it
    coarse_s_ += arcsim::cpu_seconds() - start;
    return found;
}

void Run::start_afresh() {
    from_coarse_ = false;
    x_ = flatten(p_.start.empty() ? p_.rest.x : p_.start);
    leave_trivial_branch();
    method_->allow_iterations(p_.solver.max_iterations);
}

SolveOutcome Run::solve_with_level(double tolerance, double T0, const std::string& phase) {
    SolveOutcome outcome = method_->solve(x_, tolerance, T0, phase);
    for (int raised = 0; outcome.ok() && system_.level_is_capped(); ++raised) {
        if (raised == most_cap_raises) {
            outcome_ = outcome;
            throw failure("the bag does not hold the volume asked for (" + short_number(system_.target_volume()) +
                          " m³): its level would stand more than " + short_number(most_cap_raises * system_.scales().radius) +
                          " m above the rim. Lower /formwork/plaster/fill");
        }
        system_.raise_level_cap();
        outcome = method_->solve(x_, tolerance, 0, phase);
    }
    return outcome;
}

void Run::solve_or_throw(double tolerance, double T0, const std::string& phase) {
    outcome_ = solve_with_level(tolerance, T0, phase);
    if (!outcome_.ok() && from_coarse_) {
        start_afresh();
        outcome_ = solve_with_level(tolerance, system_.scales().tension, phase);
    }
    if (!outcome_.ok()) explain_failure();
}

EquilibriumResult Run::result(bool converged) {
    EquilibriumResult r;
    measure(p_, system_, x_, r);
    r.converged = converged;
    r.residual = outcome_.residual;
    r.rounding_floor = outcome_.rounding_floor;
    r.at_rounding_floor = outcome_.status == SolveStatus::rounding_floor;
    r.iterations = method_->iterations();
    r.factorizations = method_->factorizations();
    r.coarse_iterations = coarse_iterations_;
    r.coarse_factorizations = coarse_factorizations_;
    r.method = arcsim::name_of(solver_method_names, p_.solver.method);
    r.regularisation = regularisation_;
    if (regularisation_.prestress == 0) {
        const Extent e = measure_extent(system_, x_);
        r.regularisation.depth_extrapolated_m = e.depth;
        r.regularisation.volume_extrapolated_m3 = e.volume;
    }
    r.history = method_->history();
    r.times = method_->times();
    r.times.coarse = coarse_s_;
    r.warnings = warnings_;
    if (r.at_rounding_floor && converged)
        r.warnings.push_back("the residual stopped at " + short_number(r.residual) + ", where rounding sets a floor of about " +
                             short_number(r.rounding_floor) + "; the tolerance of " + short_number(p_.solver.tolerance) +
                             " cannot be reached with this stiffness and mesh");
    return r;
}

EquilibriumResult find_equilibrium(const EquilibriumProblem& problem) {
    const auto wall = std::chrono::steady_clock::now();
    const double cpu = arcsim::cpu_seconds();
    arcsim::set_blas_threads(threads_for(problem));
    Run run(problem);
    EquilibriumResult r = run.find();
    r.cpu_s = arcsim::cpu_seconds() - cpu;
    r.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
    return r;
}

}  // namespace formwork
