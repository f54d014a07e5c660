#pragma once

#include <array>

#include "arcsim/base/types.hpp"

namespace formwork {

/// Integrals of products of the corners' linear functions phi over the part of a triangle that lies below the free
/// surface, per area of the whole triangle: W_ab = (1/A) int_wet phi_a phi_b dA, exact.
///
/// @param q  depth of the corners below the surface, m; negative above
/// @returns W, symmetric; (1 + delta_ab) / 12 where all corners are wet, 0 where all are dry
arcsim::Matrix3d wet_part(const arcsim::Vector3d& q);

}  // namespace formwork
