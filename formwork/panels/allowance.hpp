#pragma once

#include "formwork/panels/panel_params.hpp"
#include "formwork/panels/polygon.hpp"

namespace formwork {

/// The cut line: the sew line moved outwards by an allowance that differs from edge to edge, mm. Corners
/// are mitred up to `mitre_limit` allowances, else bevelled. The result never crosses itself: it is the
/// outer outline of the union of the piece, one strip per edge and one wedge per corner. A notch of the
/// outline narrower than its two allowances (a slim dart) closes: it is sewn as a fold.
/// @param sew        counter-clockwise   @param allowance  per edge i -> i+1
Polygon cut_line(const Polygon& sew, const std::vector<double>& allowance, Corner corner, double mitre_limit);

}  // namespace formwork
