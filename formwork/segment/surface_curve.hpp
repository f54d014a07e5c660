#pragma once

#include "formwork/segment/field_paths.hpp"
#include "formwork/segment/panel_patch.hpp"

namespace formwork {

/// Turns a walk over samples into a curve that crosses edges: inner vertices and runs along edges are passed
/// on the shorter side, so that every inner point is free to slide along its edge. A closed walk (first sample
/// = last) gives a closed curve; its first point is then an edge crossing as well.
/// Empty when the walk crosses one edge twice.
Curve crossing_curve(const Surface& s, const Topology& t, const FieldGraph& graph, const Path& path);

/// Straightens the staircase of a curve: each inner point slides along its edge half-way to where the line
/// between its neighbours crosses, in the unfolded pair of faces; ends stay.
void smooth_curve(const Surface& s, Curve& curve, int rounds);

/// Moves points that are close to a vertex (nearer than `reach` of the edge) onto it, and keeps the others
/// at least as far away, so that no slivers arise when the faces are split. Vertices on the border and those
/// that another part of the curve uses are not taken, except by the curve's ends.
void snap_curve(const Topology& t, Curve& curve, double reach);

double curve_length(const Surface& s, const Curve& curve);

}  // namespace formwork
