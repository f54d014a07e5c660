#pragma once

#include <array>
#include <optional>

#include "arcsim/base/archive.hpp"

namespace formwork {

enum class FabricModel {
    isotropic,   // stiffness k(lambda_max) in the frame of the principal strains (SYSTEM row 5)
    tensor       // ArcSim's orthotropic table k(strain, angle to the weave)
};
enum class IsotropicLaw {
    secant,     // S_i = k_uu(lambda_max) e_i + k_uv(lambda_max) e_j: (1), ArcSim's
    separable   // psi(e1) + psi(e2) + k_uv e1 e2 with psi'(e) = k_uu(lambda(e)) e
};
enum class Compression {
    full,          // resists compression, as ArcSim
    tension_field  // relaxed energy: wrinkled faces carry only tension
};
enum class TableSampling { exact, arcsim };

inline constexpr std::array fabric_model_names{
    arcsim::EnumName{FabricModel::isotropic, "isotropic", "k(lambda_max) in the frame of the principal strains"},
    arcsim::EnumName{FabricModel::tensor, "tensor", "orthotropic, from a material file in ArcSim's format"}};
inline constexpr std::array isotropic_law_names{
    arcsim::EnumName{IsotropicLaw::secant, "secant", "(1): stress is k(lambda_max) times strain"},
    arcsim::EnumName{IsotropicLaw::separable, "separable", "a potential: each direction stiffens by its own stretch"}};
inline constexpr std::array compression_names{
    arcsim::EnumName{Compression::tension_field, "tension_field", "wrinkled faces carry only tension"},
    arcsim::EnumName{Compression::full, "full", "the fabric resists compression, as in ArcSim"}};
inline constexpr std::array table_sampling_names{
    arcsim::EnumName{TableSampling::exact, "exact", "the interpolation between the data rows itself"},
    arcsim::EnumName{TableSampling::arcsim, "arcsim", "ArcSim's 30^3 grid"}};

/// The fabric's membrane behaviour. Stiffnesses are N/m: tension per width and strain.
struct MaterialParams {
    FabricModel model = FabricModel::isotropic;
    std::array<double, 4> rest{300, 2, 300, 37.5};   // k_uu, k_uv, k_vv, k_ss at rest (isotropic); k_ss never acts
    std::array<double, 4> max{600, 2, 600, 75};      // the same at max_stretch and beyond
    double max_stretch = 1.1666666667;               // lambda where `max` is reached
    IsotropicLaw law = IsotropicLaw::secant;
    arcsim::InputFile data;                          // tensor: material file
    TableSampling sampling = TableSampling::exact;
    Compression compression = Compression::tension_field;
    double stretching_mult = 1;                      // of every stiffness
    std::optional<double> prestress;                 // Tp, N/m; absent: automatic
    std::optional<double> residual;                  // r; absent: automatic
};

template <class Archive>
void visit(Archive& a, MaterialParams& p) {
    using namespace arcsim;
    a.choice("model", p.model, fabric_model_names, "Which law of the fabric.");
    a.when(p.model == FabricModel::isotropic, [&] {
        a.optional("rest", p.rest, "N/m", non_negative, "k_uu, k_uv, k_vv, k_ss at rest; k_ss never acts.");
        a.optional("max", p.max, "N/m", non_negative, "The same at max_stretch and beyond.");
        a.optional("max_stretch", p.max_stretch, "", above(1), "Stretch at which the row `max` is reached.");
        a.choice("law", p.law, isotropic_law_names, "How stiffness depends on stretch.");
        a.check(p.rest[0] > 0 && p.rest[0] == p.rest[2], "rest",
                "An isotropic fabric has k_uu = k_vv > 0; use the model \"tensor\" for a weave.");
        a.check(p.max[0] > 0 && p.max[0] == p.max[2], "max",
                "An isotropic fabric has k_uu = k_vv > 0; use the model \"tensor\" for a weave.");
        a.check(p.rest[1] < p.rest[0] && p.max[1] < p.max[0], "rest",
                "The coupling k_uv must be smaller than k_uu: the fabric would not be stable.");
    });
    a.when(p.model == FabricModel::tensor, [&] {
        a.required("data", p.data, "Material file in ArcSim's format; its entries are multiplied by 2 (SYSTEM row 4).");
        a.choice("sampling", p.sampling, table_sampling_names, "How the table is evaluated.");
    });
    a.choice("compression", p.compression, compression_names, "What a compressed fabric does.");
    a.optional("stretching_mult", p.stretching_mult, "", positive, "Factor of every stiffness.");
    a.when(p.compression == Compression::tension_field, [&] {
        a.optional("prestress", p.prestress, "N/m", non_negative,
                   "Small tension that makes the wrinkled shape unique; automatic when not given.");
        a.optional("residual", p.residual, "", unit_interval,
                   "Part of the stiffness that a wrinkled face keeps; automatic when not given.");
    });
}

}  // namespace formwork
