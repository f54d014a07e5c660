#pragma once

#include "arcsim/solve/cloth_system.hpp"

namespace arcsim {

/// ArcSim's relaxation of a start pose: Newton on internal energy + 1/2 |x - x_start|² (unit weight, no
/// handles, no gravity), at most ten steps
///
///   (I + H) dx = f - (x - x_start)
///
/// A step that lowers the energy by less than 1e-12 J is not applied and ends it: a start that is free of
/// stress up to the rounding of its file stays exactly as read.
/// @returns steps applied
int relax_start(ClothSystem& system, VectorXd& x);

}  // namespace arcsim
