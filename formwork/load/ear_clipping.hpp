#pragma once

#include <vector>

#include "arcsim/base/types.hpp"

namespace formwork {

/// Triangles that fill plane loops of nodes; every directed edge of a loop is used once, in its direction. Loops run
/// counter-clockwise around the area, clockwise around holes; a hole is joined to the loop around it by a double edge.
/// Where a loop crosses itself the triangles overlap, but the edges still match.
std::vector<arcsim::Triangle> triangulate_loops(std::vector<std::vector<int>> loops,
                                                const std::vector<arcsim::Vector2d>& position);

}  // namespace formwork
