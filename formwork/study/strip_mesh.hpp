#pragma once

#include <array>
#include <vector>

#include "arcsim/base/types.hpp"

namespace formwork {

using arcsim::Vector2d;

/// A flat rectangular strip of cloth between two clamps; x along its length, y across it.
struct StripMesh {
    double length = 0, width = 0;        // m; free length between the clamps
    std::vector<Vector2d> X;             // rest positions, m; the held clamp at x = 0, the moving one at x = length
    std::vector<std::array<int, 6>> elements;   // corners counter-clockwise, then the midpoints of (0,1), (1,2), (2,0)
    std::vector<int> held, moving;       // nodes in the two clamps
};

/// Rectangles cut by both diagonals (so that no direction is preferred) into quadratic triangles, finer towards
/// the clamps' corners, the only places where the strain of a strip is singular. Quadratic, because a weave cut
/// off its axes is nearly inextensible in two directions and linear triangles lock: 0.9 % too stiff with 1000
/// nodes at 45°.
///
/// @param cells_across  rectangles over the width, at least 2; about 16 cells_across² nodes for a 2:1 strip
StripMesh make_strip(double length, double width, int cells_across);

}  // namespace formwork
