#pragma once

#include "formwork/sew/sew.hpp"

namespace formwork {

/// Per face: along which direction the fabric of a sewn bag is pulled, as the target of its grain.
///
///   theta    of the larger principal tension S_1, carried from the flat panel to the surface
///   s1, s2   stretches of the fabric along it and across
///   weight   (S_1 - S_2) / the largest S_1 - S_2 of all faces: tension equal in all directions shears no weave
///
/// The fabric is woven, so this differs from the isotropic prediction: by 5 to 10 degrees in the mean of some panels of
/// the branch (SEWN.md). The tension across a wrinkle is none, its direction is known all the same.
/// @param surface  of the same faces; where theta is measured, from edge v0->v1
std::vector<DirectionData> tension_directions(const Surface& surface, const SewResult& sewn, const MaterialParams& material);

}  // namespace formwork
