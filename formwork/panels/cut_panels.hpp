#pragma once

#include <vector>

#include "formwork/panels/panel_set.hpp"

namespace formwork {

/// Takes the surface apart along its seams: every panel gets vertices of its own, nodes on a dart two of
/// them. Fills PanelSet::panels (all but u and its measures) and the sides of PanelSet::seams.
/// @throws InputError  a panel that is no disk, or an edge between panels that belongs to no seam or to two
void cut_panels(const Segmentation& s, PanelSet& set);

/// The panel as a surface of its own: local vertices in space.
Surface panel_surface(const Segmentation& s, const FlatPanel& panel);

}  // namespace formwork
