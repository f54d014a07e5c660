#pragma once

#include <filesystem>

#include "formwork/strain/strain_field.hpp"

namespace formwork {

/// strain.csv: face,lambda1,lambda2,dir_x,dir_y,dir_z,eps_uu,eps_vv,eps_uv,state; and beside it tension.csv:
/// face,tension1,tension2,dir_x,dir_y,dir_z (principal tensions, N/m; direction on the deformed surface).
void write_strain(const std::filesystem::path& folder, const StrainField& strain);

/// @param n_faces  the number that the mesh has
/// @throws InputError: missing, broken, or for another mesh
StrainField read_strain(const std::filesystem::path& folder, int n_faces);

}  // namespace formwork
