#pragma once

#include <array>
#include <filesystem>

#include "arcsim/base/types.hpp"

namespace arcsim {

struct JsonDocument;

/// Four in-plane stiffnesses of one state of the cloth, N/m, in the file's order: k_uu, k_uv (coupling),
/// k_vv, k_ss (shear). S_uu = k_uu G_uu + k_uv G_vv, S_vv = k_vv G_vv + k_uv G_uu, S_uv = k_ss G_uv with
/// the tensor shear G_uv.
using Stiffness4 = Eigen::Vector4d;

/// Row 0: unstrained, any direction. Rows 1..5: fully strained, with 0, 22.5, 45, 67.5, 90 degrees
/// between the largest principal stretch and the material's u axis.
using StretchingRows = std::array<Stiffness4, 6>;

/// Rows: direction of the fold's edge in material space, 0, 45, 90 degrees; columns: theta l / (A0 + A1)
/// = 0, 10, 20, 30, 40 1/m. N m.
using BendingRows = std::array<std::array<double, 5>, 3>;

/// The measured data of one cloth, as ArcSim's material files hold them.
struct MaterialData {
    double density = 0;         // kg/m²
    StretchingRows stretching;  // N/m, before the factor 2 of the stiffness table
    BendingRows bending{};      // N m
};

/// Reads `{"density": d, "stretching": 6 rows of 4, "bending": 3 rows of 5}`; comments are allowed, rows
/// beyond those are ignored as in ArcSim.
/// @throws InputError with file, line and pointer: missing rows, wrong lengths, numbers that are not
///         finite, a density that is not positive
MaterialData read_material(const std::filesystem::path& file);
MaterialData parse_material(const JsonDocument& document);

}  // namespace arcsim
