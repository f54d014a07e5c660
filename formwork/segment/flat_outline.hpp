#pragma once

#include <vector>

#include "formwork/segment/segmentation.hpp"

namespace formwork {

using arcsim::Vector2d;

/// Area of a flat outline over that of its convex hull: 1 for a convex piece, small for snakes and hooks.
double solidity(const std::vector<Vector2d>& outline);

/// Width of the narrowest gap between two parts of an outline, m: the least distance through the outside between a corner and
/// a side that are more than `along` m apart on the outline. Zero or next to it: the piece touches itself when it is cut.
/// Infinite for a convex piece.
double clearance(const std::vector<Vector2d>& outline, double along);

}  // namespace formwork
