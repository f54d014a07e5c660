#pragma once

#include "arcsim/base/json_value.hpp"
#include "formwork/segment/segmentation.hpp"

namespace formwork {

/// The layout without the mesh, counted from 0:
///
///   nodes   [{node, position, arcs}]            node: of the cut mesh; where three or more borders meet, or seam and rim
///   arcs    [{kind: seam|rim|dart, from, to, panels: [left, right], length_m}]   from, to: layout nodes; null: closed
///   panels  [{area_m2, outline: [[arc, direction], ...], neighbours}]   direction 1: along the arc, -1: against
arcsim::JsonValue layout_json(const Segmentation& s);

}  // namespace formwork
