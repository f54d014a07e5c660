#pragma once

#include "formwork/panels/pattern.hpp"

namespace formwork {

/// An order of assembly in which every seam can be reached from outside the bag:
/// darts, then seams that join two parts (flat work), then seams that close a part on itself, then one hem
/// around each loop of rims. The pouring opening comes last: the highest loop's hem, or on a closed bag the
/// seam that lies highest along `up`. Where a seam ends in the middle of a straight run of two others it is
/// sewn before them, so that the run is sewn in one go.
/// @throws NumericalError when a step would be inside a closed bag (never, by construction: checked)
std::vector<SewingStep> sewing_order(const PanelSet& set, const Segmentation& s, const Vector3d& up);

}  // namespace formwork
