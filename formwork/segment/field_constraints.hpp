#pragma once

#include <string>
#include <vector>

#include "arcsim/base/archive.hpp"
#include "formwork/segment/cross_field.hpp"

namespace formwork {

/// A curve that the designer drew on or near the surface, m.
using Stroke = std::vector<arcsim::Vector3d>;

/// Directions that the field must keep whatever the strain says.
struct ConstraintParams {
    bool align_rims = false;       // the field runs along (or across) every rim
    double crease_angle_deg = 0;   // edges that bend by more are followed; 0: none
    arcsim::InputFile strokes;     // OBJ file of polylines: v and l lines
};

/// Keys of the `segment` block.
template <class Archive>
void visit(Archive& a, ConstraintParams& p) {
    a.optional("align_rims", p.align_rims, "Whether the field must run along or across the rims.");
    a.optional("crease_angle_deg", p.crease_angle_deg, "degrees", arcsim::between(0, 180),
               "Edges that bend by more than this are followed by the field, and tried as seams where they part the surface; 0: none.");
    a.optional("strokes", p.strokes, "OBJ file of polylines (v and l lines) that the field must follow and that become seams.");
}

/// Rims, creases and strokes as directions of faces. A face that is asked for two directions more than 20
/// degrees apart (modulo a quarter turn) is left free.
/// @throws InputError   a stroke further from the surface than 5 % of its diagonal
std::vector<HardDirection> hard_directions(const Surface& s, const Topology& t, const ConstraintParams& params,
                                           const std::vector<Stroke>& strokes);

/// The polylines of an OBJ file.
/// @throws InputError   unreadable, or an index out of range; names file and line
std::vector<Stroke> read_strokes(const std::string& path);

}  // namespace formwork
