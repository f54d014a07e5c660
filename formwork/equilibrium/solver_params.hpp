#pragma once

#include <array>
#include <optional>

#include "arcsim/base/archive.hpp"

namespace formwork {

enum class SolverMethod { static_newton, backward_euler, newton_euler, bdf2, dynamic_relaxation, projective };
inline constexpr std::array solver_method_names{
    arcsim::EnumName{SolverMethod::static_newton, "static", "Newton's method on the equilibrium"},
    arcsim::EnumName{SolverMethod::backward_euler, "backward_euler", "linearly implicit steps in time until at rest"},
    arcsim::EnumName{SolverMethod::newton_euler, "newton_euler", "fully implicit steps that grow until at rest"},
    arcsim::EnumName{SolverMethod::bdf2, "bdf2", "second-order implicit steps in time until at rest"},
    arcsim::EnumName{SolverMethod::dynamic_relaxation, "dynamic_relaxation", "explicit steps with kinetic damping"},
    arcsim::EnumName{SolverMethod::projective, "projective", "one constant factor and L-BFGS: quick to a rough shape"}};

enum class LinearSolverChoice { cholmod, umfpack, eigen, pcg };
inline constexpr std::array linear_solver_names{
    arcsim::EnumName{LinearSolverChoice::cholmod, "cholmod", "supernodal Cholesky of the symmetric tangent"},
    arcsim::EnumName{LinearSolverChoice::umfpack, "umfpack", "LU of the unsymmetric tangent"},
    arcsim::EnumName{LinearSolverChoice::eigen, "eigen", "Eigen's LDLT, for comparison"},
    arcsim::EnumName{LinearSolverChoice::pcg, "pcg", "conjugate gradients on an incomplete factor, for comparison"}};

/// How the equilibrium is found.
struct SolverParams {
    SolverMethod method = SolverMethod::static_newton;
    double tolerance = 1e-8;       // |f_free| / |applied load|
    double time_step = 0.01;       // s; methods in time
    double end_time = 10;          // s; methods in time take at most end_time / time_step steps
    int max_iterations = 200;      // Newton steps in all; see the key table for the others
    double damping = 0;            // s; stiffness-proportional damping beta of the fabric; methods in time
    LinearSolverChoice linear_solver = LinearSolverChoice::cholmod;
    int threads = 0;               // 0: one below 40 000 nodes, all above
    std::optional<double> accuracy;   // wanted, relative, of depth and volume: decides on method and tolerance
    bool nested = true;            // start from the solution on coarser meshes where that pays
};

/// Sets method and tolerance by the wanted accuracy, from the measurements in docs/speed_accuracy: `static` is the quickest
/// or nearly so at every accuracy there, the error that a residual leaves in depth and volume stayed below it with every
/// method, and the consistent load serves every accuracy.
inline void choose_by_accuracy(SolverParams& p) {
    p.method = SolverMethod::static_newton;
    p.tolerance = *p.accuracy / 10;
}

template <class Archive>
void visit(Archive& a, SolverParams& p) {
    using namespace arcsim;
    a.optional("accuracy", p.accuracy, "", between(1e-6, 0.1),
               "Wanted relative accuracy of depth and volume, beside the mesh's own error (which is warned of): chooses method and "
               "tolerance, and how far a wrinkled fabric's prestress is lowered (docs/speed_accuracy). Stands instead of both.");
    a.when(!p.accuracy, [&] {
        a.choice("method", p.method, solver_method_names, "How the equilibrium is found.");
        a.optional("tolerance", p.tolerance, "", positive, "Force residual relative to the applied load.");
    });
    if (p.accuracy) choose_by_accuracy(p);
    a.optional("time_step", p.time_step, "s", positive, "Step of the methods in time; shorter where it has to be; newton_euler lets it grow.");
    a.optional("end_time", p.end_time, "s", positive, "The methods in time stop after end_time / time_step steps at the latest.");
    a.optional("max_iterations", p.max_iterations, "", at_least(1),
               "Newton steps in all; dynamic_relaxation: hundreds of its steps; projective: twenties.");
    a.optional("damping", p.damping, "s", non_negative, "Stiffness-proportional damping; methods in time.");
    a.choice("linear_solver", p.linear_solver, linear_solver_names, "Factorisation of the tangent.");
    a.optional("threads", p.threads, "", non_negative, "Threads; 0: one below 40 000 nodes, all above.");
    a.optional("nested", p.nested, "Start from the solution on coarser meshes where that pays.");
}

}  // namespace formwork
