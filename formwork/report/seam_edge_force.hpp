#pragma once

#include <array>

namespace formwork {

/// What the thread along one edge of a seam carries.
struct SeamEdgeForce {
    std::array<int, 2> node{0, 0};  // of the cut mesh
    double force_N = 0;             // below 0: it pushes
};

}  // namespace formwork
