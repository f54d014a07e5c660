#pragma once

#include <vector>

#include "formwork/segment/panel_split.hpp"

namespace formwork {

/// Darts for a disk: cuts from its border towards the place where its curvature gathers, which leave it one disk. They run
/// where steps along the field are cheapest, and reach all, three quarters and half of the way.
/// @returns curves in the patch's numbering, from the border on, ready to be inserted; none when that place is at the border
std::vector<Curve> dart_curves(const PanelPatch& patch, const SurfaceField& field, const SplitRules& rules);

}  // namespace formwork
