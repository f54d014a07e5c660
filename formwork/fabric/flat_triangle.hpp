#pragma once

#include <array>

#include "arcsim/base/types.hpp"

namespace formwork {

/// Rest coordinates of a face's three corners in the weave frame (u warp, v weft), counter-clockwise, m.
using FlatTriangle = std::array<arcsim::Vector2d, 3>;

}  // namespace formwork
