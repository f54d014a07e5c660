#pragma once

#include "arcsim/base/json_value.hpp"
#include "arcsim/mesh/cloth_mesh.hpp"
#include "formwork/equilibrium/equilibrium.hpp"

namespace formwork {

/// The figures of SYSTEM §5 that inflate and sew share.
arcsim::JsonValue equilibrium_summary(const EquilibriumResult& result);

/// One face's corners in rest coordinates as verts: the mesh `faces` at `x` with vt = `flat`.
arcsim::ClothMesh mesh_with_rest(const std::vector<Vector3d>& x, const std::vector<Triangle>& faces,
                                 const std::vector<FlatTriangle>& flat);

}  // namespace formwork
