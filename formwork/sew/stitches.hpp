#pragma once

#include "formwork/sew/sewn_bag.hpp"

namespace formwork {

/// Gives every panel seam nodes of its own and joins them by springs of zero length, L = 0 in (10): the seam can
/// gap. The thread's springs then run along both sides, each with half of kappa. Where a dart ends, and at held
/// nodes, the panels keep their common node.
///
/// The liquid's pressure has no exact potential across a gap; the tangent's antisymmetric part, which comes from
/// the gaping edges alone, is dropped by a symmetric solver.
void split_into_stitches(const Segmentation& s, const SewParams& params, SewnBag& bag);

}  // namespace formwork
