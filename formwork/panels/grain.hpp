#pragma once

#include "formwork/flatten/flatten.hpp"
#include "formwork/panels/panel_set.hpp"

namespace formwork {

/// Turns the flat panel so that its first axis, the warp, follows the target directions as well as one
/// rotation can:
///
///   phi = arg(sum A w e^{4 i psi}) / 4,   then phi or phi + 90° by the sign of sum A w cos 2(psi - phi)
///
/// psi is the direction of the larger stretch pulled into the plane, w its weight. A panel without data
/// follows the smoothed field, its warp along the panel's longer side.
/// @param shapes  of the panel's faces on the surface (rest_shapes)
void turn_to_grain(const Segmentation& s, const std::vector<Matrix2d>& shapes, WarpAlong warp, FlatPanel& panel);

/// Sets grain_deviation_deg, grain_coherence and grain_error_deg of a panel that lies in its grain.
void measure_grain(const Segmentation& s, const std::vector<Matrix2d>& shapes, FlatPanel& panel);

}  // namespace formwork
