#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "arcsim/base/archive.hpp"
#include "formwork/equilibrium/solver_params.hpp"
#include "formwork/fabric/material_params.hpp"
#include "formwork/load/plaster_params.hpp"

namespace formwork {

/// How the panels hold together along a seam.
enum class SeamModel {
    shared,   // both panels share the seam's nodes
    stitch    // nodes of their own, joined by springs of zero length: the seam can gap
};
inline constexpr std::array seam_model_names{
    arcsim::EnumName{SeamModel::shared, "shared", "both panels share the seam's nodes"},
    arcsim::EnumName{SeamModel::stitch, "stitch", "nodes of their own, joined by springs of zero length: the seam can gap"}};

/// What a seam's thread does when its edge becomes shorter than at rest.
enum class ThreadCompression { slack, full };
inline constexpr std::array thread_compression_names{
    arcsim::EnumName{ThreadCompression::slack, "slack", "nothing: a thread cannot push"},
    arcsim::EnumName{ThreadCompression::full, "full", "it pushes, as (10) reads: many equilibria; the one nearest to the slack bag is taken"}};

/// Where the search for the sewn equilibrium begins; the result must not depend on it.
enum class SewStart { inflated, rest };
inline constexpr std::array sew_start_names{
    arcsim::EnumName{SewStart::inflated, "inflated", "from the filled isotropic bag"},
    arcsim::EnumName{SewStart::rest, "rest", "from the surface that was cut"}};

/// Keys of `formwork.sew`.
///
/// In tension the thread is (10). Where its edge becomes shorter than L, (10) as it is written pushes ("full"), and SYSTEM
/// row 11 keeps that; the default departs from it ("slack"), for the reason of row 14. A chain of springs that push and do
/// not bend gives way sideways at 4 P / L of lateral stiffness, P the push: any push wins over the membrane's tension once
/// the mesh is fine, every node may fold to either side, and the energy has as many minima. ½ kappa (l - L)²₊, the slack
/// thread, is the convex envelope of ½ kappa (l - L)² over x_ij: what the folded chain carries on average, exactly as the
/// tension field is for the cloth beside it. It has one state, and finer meshes approach it. Measured (SEWN.md): in the
/// filled bags a third to three quarters of all seam edges are shorter than at rest; from either start slack threads end
/// in one state; pushing threads end up to 3 mm apart, or find no equilibrium from one of the starts.
/// "full" therefore begins where the slack bag has come to rest (find_sewn_equilibrium): one state from either start.
struct SewParams {
    MaterialParams material = [] {
        MaterialParams m;
        m.model = FabricModel::tensor;
        return m;
    }();
    double density = 0.2;                    // fabric, kg/m²
    bool self_weight = true;
    double seam_stiffness = 5e5;             // kappa of (10), N/m per seam edge
    std::optional<double> seam_EA;           // N; replaces kappa by EA / L
    ThreadCompression thread_compression = ThreadCompression::slack;
    SeamModel seams = SeamModel::shared;
    double stitch_stiffness = 5e5;           // N/m per stitch
    SewStart start = SewStart::inflated;
    std::optional<double> strength;          // N/m, breaking force per width
    std::optional<arcsim::InputFile> target; // mesh that the cast should have
    std::vector<std::string> compare;        // baselines
    int seed = 1;                            // of the random grain
    PressureQuadrature pressure = PressureQuadrature::consistent;
    PressureJacobian pressure_jacobian = PressureJacobian::consistent;
    SolverParams solver;

    /// kappa of a seam edge of rest length L, N/m.
    double kappa(double L) const { return seam_EA ? *seam_EA / L : seam_stiffness; }
};

inline bool is_grain_variant(const std::string& name) { return name == "rotated_45" || name == "random"; }

template <class Archive>
void visit(Archive& a, SewParams& p) {
    using namespace arcsim;
    a.nested("material", p.material, "The woven fabric that the panels are cut from.");
    a.optional("density", p.density, "kg/m²", non_negative, "Of the fabric.");
    a.optional("self_weight", p.self_weight, "The fabric's own weight acts.");
    a.optional("seam_stiffness", p.seam_stiffness, "N/m", non_negative,
               "kappa of (10), per seam edge: the seam's stiffness EA = kappa L then depends on the mesh.");
    a.optional("seam_EA", p.seam_EA, "N", positive,
               "Stiffness of a seam as a thread; kappa = EA / L, independent of the mesh. Replaces seam_stiffness.");
    a.choice("thread_compression", p.thread_compression, thread_compression_names,
             "What the thread does where its seam becomes shorter than at rest.");
    a.choice("seams", p.seams, seam_model_names, "How the panels hold together.");
    a.optional("stitch_stiffness", p.stitch_stiffness, "N/m", positive, "Of each stitch, with seams: stitch.");
    a.choice("start", p.start, sew_start_names, "Where the search for the equilibrium begins.");
    a.optional("strength", p.strength, "N/m", positive,
               "Breaking force of the fabric per width; the report then shows the utilisation.");
    a.optional("target", p.target, "Mesh of the shape that the cast should have, in the scene's units; deviations are reported.");
    a.optional("compare", p.compare, "The same panels with other grain, for comparison: \"rotated_45\", \"random\".");
    for (const std::string& name : p.compare)
        a.check(is_grain_variant(name), "compare", "\"" + name + "\" is not known: \"rotated_45\" or \"random\".");
    a.optional("seed", p.seed, "", any_number, "Seed of the random grain.");
    a.choice("pressure", p.pressure, pressure_quadrature_names, "How the liquid's pressure becomes forces.");
    a.choice("pressure_jacobian", p.pressure_jacobian, pressure_jacobian_names, "Derivative of the pressure in the tangent.");
    a.nested("solver", p.solver, "How the equilibrium is found.");
}

}  // namespace formwork
