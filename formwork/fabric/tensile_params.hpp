#pragma once

#include <array>
#include <optional>
#include <vector>

#include "arcsim/base/archive.hpp"
#include "formwork/fabric/material_params.hpp"

namespace formwork {

/// How the moving clamp is driven (§10).
enum class TensileControl { displacement, force };
inline constexpr std::array tensile_control_names{
    arcsim::EnumName{TensileControl::displacement, "displacement", "the clamp's path is prescribed"},
    arcsim::EnumName{TensileControl::force, "force", "the force's history is prescribed, the path is found"}};

/// Keys of `formwork.tensile`: the Instron test of §9-10.
struct TensileParams {
    MaterialParams material = [] {
        MaterialParams m;
        m.model = FabricModel::tensor;
        m.compression = Compression::full;
        return m;
    }();
    double length_mm = 40, width_mm = 20;       // between the clamps
    std::vector<double> angles_deg{0, 22.5, 45, 67.5, 90};
    TensileControl control = TensileControl::displacement;
    double max_strain = 0.05;                   // of the last displacement
    int steps = 20;
    double rate_mm_per_min = 2;
    std::optional<double> breaking_force_N;
    std::optional<arcsim::InputFile> measured;
    int resolution = 12;
};
template <class Archive>
void visit(Archive& a, TensileParams& p) {
    using namespace arcsim;
    a.nested("material", p.material, "The fabric. The strip is held flat, so it resists compression whatever `compression` says.");
    a.check(p.material.model == FabricModel::tensor ? p.material.sampling == TableSampling::exact
                                                    : p.material.law == IsotropicLaw::secant,
            "material", "the strip knows the secant law and exact sampling.");
    a.optional("length_mm", p.length_mm, "mm", positive, "Free length between the clamps.");
    a.optional("width_mm", p.width_mm, "mm", positive, "Width of the strip.");
    a.optional("angles_deg", p.angles_deg, "degrees", any_number, "From the warp to the strip's axis, one strip each.");
    a.choice("control", p.control, tensile_control_names, "How the moving clamp is driven.");
    a.optional("max_strain", p.max_strain, "", positive, "Largest displacement over the length, where no measured curve says more.");
    a.optional("steps", p.steps, "", between(1, 100000), "Points of a curve, where no measured curve gives them.");
    a.optional("rate_mm_per_min", p.rate_mm_per_min, "mm/min", positive, "Speed of the clamp: time_s, where no measured history has a clock of its own.");
    a.optional("breaking_force_N", p.breaking_force_N, "N", positive, "The strip breaks here and the curve ends; with control force, the last force.");
    a.optional("measured", p.measured, "CSV with the columns angle_deg,displacement_mm,force_N and, if there is one, time_s: its points are followed, and each curve ends where the measured one does.");
    a.optional("resolution", p.resolution, "", between(2, 400), "Cells over the width: about 16 resolution² nodes for a strip twice as long as wide.");
}

/// Which table is estimated.
enum class FitModel { tensor, isotropic };
inline constexpr std::array fit_model_names{
    arcsim::EnumName{FitModel::tensor, "tensor", "the 24 entries of a material file in ArcSim's format"},
    arcsim::EnumName{FitModel::isotropic, "isotropic", "k_uu and k_uv at rest and at max_stretch"}};

/// Keys of `formwork.fit`.
struct FitParams {
    arcsim::InputFile measured;
    FitModel model = FitModel::tensor;
    std::optional<arcsim::InputFile> initial;
    double length_mm = 40, width_mm = 20;
    int resolution = 6;
    int points_per_curve = 12;
    double noise = 0.01;              // standard deviation of a force, of itself
    double noise_floor_N = 1e-3;
    double prior_width = 10;
    double largest = 1e8;             // N/m
    int max_iterations = 40;
};
template <class Archive>
void visit(Archive& a, FitParams& p) {
    using namespace arcsim;
    a.required("measured", p.measured, "CSV with the columns angle_deg,displacement_mm,force_N.");
    a.choice("model", p.model, fit_model_names, "Which table is estimated.");
    a.optional("initial", p.initial, "Material file to start from; else the start is estimated from the curves' slopes.");
    a.optional("length_mm", p.length_mm, "mm", positive, "Free length between the clamps.");
    a.optional("width_mm", p.width_mm, "mm", positive, "Width of the strip.");
    a.optional("resolution", p.resolution, "", between(2, 100), "Cells over the strip's width.");
    a.optional("points_per_curve", p.points_per_curve, "", between(2, 1000), "Measured points that are used, spread over each curve.");
    a.optional("noise", p.noise, "", positive, "Standard deviation of a measured force, as a part of it.");
    a.optional("noise_floor_N", p.noise_floor_N, "N", positive, "Standard deviation of the smallest forces.");
    a.optional("prior_width", p.prior_width, "", positive,
               "How far an entry may lie from its start, as a multiple of it (one standard deviation): only holds what the data leave open.");
    a.optional("largest", p.largest, "N/m", positive, "Upper bound of every entry; the lower one is 0.");
    a.optional("max_iterations", p.max_iterations, "", at_least(1), "Levenberg-Marquardt steps.");
}

}  // namespace formwork
