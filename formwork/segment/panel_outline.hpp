#pragma once

#include <vector>

#include "formwork/segment/panel_patch.hpp"

namespace formwork {

/// Corners of a patch: places where the outline, seen over an arm's length, turns within the surface by more than 50°, or by
/// more than 40° at a junction. The turns within the arm are summed, nearer ones weighing more, so that the teeth of a ragged
/// rim, noise, and steps shorter than an arm cancel, and a corner counts once however many nodes share it. The arm is 1/16 of
/// the loop, and at least four edges (but not more than 1/8 of the loop). Turns of seams that were asked for do not
/// count, nor do darts, which are sewn before the panel is.
/// @param care  a search that must still keep the bound once its seams are straightened counts corners from `care` times
///              these turns on, care < 1
/// @returns local node numbers, along the boundary loops
std::vector<int> corner_nodes(const PanelPatch& patch, double care = 1);

/// What makes an outline easy or hard to sew.
struct OutlineShape {
    int corners = 0;
    double sharpest = 3.1416;   // rad: least opening of a corner, seen over a stretch of outline; necks count once the panel is flat
    int inner_corners = 0;      // of the corners, those that turn inwards: the neighbour's tip has to be set into them
};
/// @param reach  m of outline on either side over which the opening of a corner is measured: a long thin tip counts
///               as sharp whatever the angle at its very end
/// @param care  as for corner_nodes
OutlineShape outline_shape(const PanelPatch& patch, double reach, double care = 1);

}  // namespace formwork
