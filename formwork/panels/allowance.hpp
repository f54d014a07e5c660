#pragma once

#include "formwork/panels/panel_params.hpp"
#include "formwork/panels/polygon.hpp"

namespace formwork {

/// The cut line: the sew line moved outwards by an allowance that differs from edge to edge, mm. Corners
/// are mitred up to `mitre_limit` allowances, else bevelled. The result never crosses itself: it is the
/// outer outline of the union of the piece, one strip per edge and one wedge per corner. A notch of the
/// outline narrower than its two allowances (a slim dart) closes: it is sewn as a fold.
///
/// A hem is folded in along its edges. Where it meets a seam its end is the mirror image, in the fold, of the
/// seam's cut line: folded, it lies on the piece and neither sticks out beside the seam nor leaves a gap.
/// @param sew        counter-clockwise
/// @param allowance  per edge i -> i+1
/// @param folded     per edge: it is a hem's fold; empty: none is
Polygon cut_line(const Polygon& sew, const std::vector<double>& allowance, Corner corner, double mitre_limit,
                 const std::vector<char>& folded = {});

}  // namespace formwork
