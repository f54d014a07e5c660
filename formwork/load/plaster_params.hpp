#pragma once

#include <array>
#include <optional>

#include "arcsim/base/archive.hpp"

namespace formwork {

/// How far the bag is filled: exactly one of the four.
struct FillParams {
    std::optional<double> level;             // of the free surface along `up`, m
    std::optional<double> depth_below_rim;   // of the free surface below the mean height of the held nodes, m
    std::optional<double> volume;            // of liquid, m³; the level becomes an unknown
    std::optional<double> fraction;          // of the rest shape's capacity; the level becomes an unknown
};

template <class Archive>
void visit(Archive& a, FillParams& p) {
    using namespace arcsim;
    a.optional("level", p.level, "m", any_number, "Height of the free surface along `up`, in world coordinates.");
    a.optional("depth_below_rim", p.depth_below_rim, "m", any_number,
               "Depth of the free surface below the mean height of the held nodes.");
    a.optional("volume", p.volume, "m³", positive, "Volume of liquid; the level is found together with the shape.");
    a.optional("fraction", p.fraction, "", positive, "Volume of liquid as a part of the rest shape's capacity.");
    a.exactly_one_of({"level", "depth_below_rim", "volume", "fraction"});
}

/// The wet plaster.
struct PlasterParams {
    double density = 0;               // rho, kg/m³; 0: overpressure alone
    double gravity = 9.81;            // m/s²
    std::optional<FillParams> fill;   // required when density > 0
    double overpressure = 0;          // Pa, added everywhere
};

template <class Archive>
void visit(Archive& a, PlasterParams& p) {
    using namespace arcsim;
    a.required("density", p.density, "kg/m³", non_negative, "Density of the liquid plaster; 0: overpressure alone.");
    a.optional("gravity", p.gravity, "m/s²", positive, "Acceleration of gravity.");
    a.nested("fill", p.fill, "How far the bag is filled.");
    a.optional("overpressure", p.overpressure, "Pa", any_number, "Uniform inflow pressure, added everywhere.");
    a.check(p.density == 0 || p.fill.has_value(), "fill",
            "Say how far the bag is filled: level, depth_below_rim, volume or fraction.");
}

/// How the pressure becomes forces on nodes (SYSTEM row 9).
enum class PressureQuadrature {
    consistent,   // exact integral of the linear pressure over each triangle, clipped at the free surface
    lumped        // (8): the node's pressure times its share of the area
};
/// What of the pressure's derivative enters the tangent (SYSTEM row 8).
enum class PressureJacobian { consistent, lumped, none };

inline constexpr std::array pressure_quadrature_names{
    arcsim::EnumName{PressureQuadrature::consistent, "consistent", "exact integral over each triangle"},
    arcsim::EnumName{PressureQuadrature::lumped, "lumped", "(8): one value per node"}};
inline constexpr std::array pressure_jacobian_names{
    arcsim::EnumName{PressureJacobian::consistent, "consistent", "exact second derivative"},
    arcsim::EnumName{PressureJacobian::lumped, "lumped", "(9): -A rho g n d^T per node"},
    arcsim::EnumName{PressureJacobian::none, "none", "left out"}};

}  // namespace formwork
