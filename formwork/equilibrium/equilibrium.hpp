#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "arcsim/base/error.hpp"
#include "arcsim/base/types.hpp"
#include "arcsim/mesh/surface.hpp"
#include "formwork/equilibrium/solver_params.hpp"
#include "formwork/fabric/flat_triangle.hpp"
#include "formwork/fabric/material_params.hpp"
#include "formwork/fabric/seam_spring.hpp"
#include "formwork/load/plaster_params.hpp"
#include "formwork/strain/strain_field.hpp"

namespace formwork {

using arcsim::Matrix32d;
using arcsim::Surface;
using arcsim::Triangle;
using arcsim::Vector2d;
using arcsim::Vector3d;
using arcsim::VectorXd;


/// Every face in its own plane: u along the edge from corner 0 to corner 1.
std::vector<FlatTriangle> rest_in_own_planes(const Surface& rest);

/// One line of progress and of the convergence history.
struct IterationReport {
    int iteration = 0;
    double residual = 0;       // |f_free| / |applied load|
    int factorizations = 0;    // so far
    double step = 1;           // accepted part of the Newton step
    double max_stretch = 0;
    std::string phase;         // "coarse 1", "prestressed", "final", ...
};

/// What is to be brought into equilibrium. `inflate` and `sew` differ only in what they put here.
struct EquilibriumProblem {
    Surface rest;                       // rest shape in space: faces, and where strain directions are reported
    std::vector<FlatTriangle> flat;     // per face; empty: rest_in_own_planes(rest)
    std::vector<Vector3d> start;        // positions to start from; empty: the rest shape
    std::vector<char> fixed;            // 3n flags by 3 node + axis; held at `start`
    Vector3d up{0, 0, 1};               // d, unit
    PlasterParams plaster;
    PressureQuadrature pressure = PressureQuadrature::consistent;
    PressureJacobian pressure_jacobian = PressureJacobian::consistent;
    MaterialParams material;
    double fabric_density = 0;          // kg/m²
    bool self_weight = true;
    std::vector<SeamSpring> seams;
    SolverParams solver;
    std::function<void(const IterationReport&)> on_iteration;   // may throw Interrupted
};

/// What the tension field's regularisation (a small prestress Tp and residual stiffness r) did to the answer.
struct Regularisation {
    double prestress = 0;               // Tp left in the answer, N/m; 0 where nothing wrinkles
    double residual = 0;                // r left in the answer
    double depth_effect = 0;            // estimated relative change of depth that Tp and r still make
    double volume_effect = 0;           // the same for the volume
    double depth_extrapolated_m = 0;    // to Tp = r = 0
    double volume_extrapolated_m3 = 0;
};

/// CPU seconds by kind of work.
struct SolverTimes {
    double assembly = 0, ordering = 0, symbolic = 0, numeric = 0, solve = 0, line_search = 0, total = 0;
    double coarse = 0;   // everything on coarser meshes; in no other figure
};

struct EquilibriumResult {
    std::vector<Vector3d> x;            // m
    StrainField strain;                 // per face
    bool converged = false;
    double residual = 0;                // |f_free| / |applied load|
    double rounding_floor = 0;          // estimate of the residual that rounding alone makes; same unit
    bool at_rounding_floor = false;     // converged to the floor, which lies above the tolerance
    int iterations = 0;                 // on the mesh itself
    int factorizations = 0;
    int coarse_iterations = 0;          // on the coarser meshes that it started from
    int coarse_factorizations = 0;
    int vertices = 0, faces = 0, free_dofs = 0;
    double wall_s = 0, cpu_s = 0, peak_rss_mb = 0;
    double fill_level_m = 0;            // coordinate along up; NaN without liquid
    double depth_m = 0;                 // lowest point below the level; without liquid: how far it reaches below or above the held nodes
    double depth_below_rim_m = 0;       // lowest point below the mean height of the held nodes
    double volume_m3 = 0;               // of liquid, below the level
    double capacity_m3 = 0;             // enclosed up to the rim plane
    double liquid_mass_kg = 0;
    Vector3d support_force_N{0, 0, 0};  // that the held nodes receive from the supports
    double max_stretch = 1, min_stretch = 1;
    int wrinkled_faces = 0, slack_faces = 0;
    std::string method;
    int orientation = 1;                // +1: the faces' normals point out of the liquid; -1: into it
    Regularisation regularisation;
    std::vector<IterationReport> history;
    std::vector<std::string> warnings;
    SolverTimes times;
};

/// No equilibrium was reached. `last` holds the last good state, not converged.
struct EquilibriumError : arcsim::NumericalError {
    EquilibriumError(const std::string& what, EquilibriumResult state)
        : NumericalError(what), last(std::make_shared<EquilibriumResult>(std::move(state))) {}
    std::shared_ptr<const EquilibriumResult> last;
};

/// Finds the shape in which the fabric's forces, the liquid's pressure, self-weight and seams balance.
///
/// @throws InputError         sizes do not fit, a degenerate rest face, a fill that the bag cannot have
/// @throws EquilibriumError   free rigid modes, ballooning, runaway units, no convergence; see STABILITY rows in
///                            the message. Never returns a state that did not converge.
EquilibriumResult find_equilibrium(const EquilibriumProblem& problem);

}  // namespace formwork
