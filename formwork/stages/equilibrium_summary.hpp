#pragma once

#include <filesystem>
#include <string>

#include "arcsim/base/json_value.hpp"
#include "arcsim/mesh/cloth_mesh.hpp"
#include "formwork/equilibrium/equilibrium.hpp"

namespace formwork {

/// The figures of SYSTEM §5 that inflate and sew share.
arcsim::JsonValue equilibrium_summary(const EquilibriumResult& result);

/// What to say of a bag filled by volume or fraction whose liquid stands above the rim, where poured liquid would run over; "" when
/// it does not. A level that the scene itself sets above the rim is a head that was asked for.
std::string doubt_about_overflow(const EquilibriumResult& result, const PlasterParams& plaster);

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
