#pragma once

#include "formwork/segment/cut_mesh.hpp"

namespace formwork {

/// Marks the edges of the mesh that bend by more than `angle`, rad, as seams to begin with: those that part the surface, alone or
/// with the rims, into pieces at least `min_width` m wide. Creases that end inside a piece, and pieces narrower than that
/// (noise, fillets of a few faces), are left out. The search takes away again what it does not need.
/// @returns whether there are any
bool mark_crease_seams(CutMesh& cut, double angle, double min_width);

}  // namespace formwork
