#pragma once

#include <filesystem>
#include <string>

#include "arcsim/base/json_value.hpp"
#include "arcsim/mesh/cloth_mesh.hpp"
#include "formwork/equilibrium/equilibrium.hpp"

namespace formwork {

/// The figures of SYSTEM §5 that inflate and sew share.
arcsim::JsonValue equilibrium_summary(const EquilibriumResult& result);

/// One face's corners in rest coordinates as verts: the mesh `faces` at `x` with vt = `flat`.
arcsim::ClothMesh mesh_with_rest(const std::vector<Vector3d>& x, const std::vector<Triangle>& faces,
                                 const std::vector<FlatTriangle>& flat);

/// Keeps the last good state of a search that failed as `folder`/not_converged.obj.
/// @param last  the bag's mesh at e.last
/// @returns the error to throw: it names the stage, what `e` says, and the file
arcsim::NumericalError keep_unconverged(const std::string& stage, const std::filesystem::path& folder, const EquilibriumError& e,
                                        const arcsim::ClothMesh& last);

/// Takes away what an earlier attempt kept.
void forget_unconverged(const std::filesystem::path& folder);

}  // namespace formwork
