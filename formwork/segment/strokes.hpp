#pragma once

#include "formwork/segment/field_constraints.hpp"
#include "formwork/segment/layout.hpp"

namespace formwork {

/// The shortest curve on the layout's mesh through the nodes nearest to the stroke's points; an end within two
/// edges of the rim goes on to the rim. Legs that run along edges of the mesh keep to them exactly (a fold, a sewn
/// edge); the others cross faces and are smoothed.
/// @param number  of the stroke, from 0, for messages
/// @throws InputError   fewer than two points, points that fall on one node, a stroke that crosses itself
Curve stroke_curve(const Layout& layout, const Stroke& stroke, int number);

}  // namespace formwork
