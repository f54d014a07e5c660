#pragma once

#include "arcsim/mesh/cloth_mesh.hpp"
#include "formwork/panels/panel_set.hpp"

namespace formwork {

/// The whole bag as a cloth: nodes of the cut surface, shared across seams; verts are the panels' flat
/// coordinates, m, first axis warp; one group per panel. Faces stand in the order of the cut mesh, so that
/// results per face of the sewn bag fit the segmentation. Nodes on a rim carry label 1, so that a handle of
/// an ArcSim scene can hold them by label.
arcsim::ClothMesh sewn_rest(const PanelSet& set, const Segmentation& s);

}  // namespace formwork
