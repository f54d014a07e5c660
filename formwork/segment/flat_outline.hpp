#pragma once

#include <vector>

#include "formwork/segment/segmentation.hpp"

namespace formwork {

using arcsim::Vector2d;

/// Area of a flat outline over that of its convex hull: 1 for a convex piece, small for snakes and hooks.
double solidity(const std::vector<Vector2d>& outline);

/// Where parts of a flat outline that are far apart along it come near each other.
struct OutlineGaps {
    double inlet;   // m: narrowest through the outside; next to zero: the piece touches itself. Infinite for a convex piece
    double neck;    // narrowest through the inside, over the way along the outline (at most 2 `reach`): the sine of half the
                    // opening of a tip, and small, too, where a flap hangs on a narrow neck. 1 when there is none
};
/// @param reach  m: parts less than that apart along the outline do not count for an inlet, less than half of it not for a neck
OutlineGaps outline_gaps(const std::vector<Vector2d>& outline, double reach);

}  // namespace formwork
