#pragma once

#include "formwork/flatten/flatten.hpp"
#include "formwork/panels/panel_set.hpp"

namespace formwork {

/// Makes every face smaller by its simulated stretch: shape := R(theta) diag(1/s1, 1/s2) R(theta)ᵀ shape, so
/// that the filled bag, stretched by s1 and s2, has the size of the surface that is cut.
/// @param shapes  of the panel's faces (rest_shapes); changed
void relax_stretch(const Segmentation& s, const FlatPanel& panel, std::vector<Matrix2d>& shapes);

/// Makes every face smaller by percentages along warp and weft, as makers of tensile membranes do. The
/// panel must lie in its grain already: the face's rotation in the plane says what warp is to it.
/// @param percent  warp, weft   @param shapes  changed; the panel's u shrinks with them
void shrink_to_weave(const std::array<double, 2>& percent, FlatPanel& panel, std::vector<Matrix2d>& shapes);

}  // namespace formwork
