#pragma once

#include <limits>
#include <vector>

#include "formwork/segment/panel_patch.hpp"
#include "formwork/segment/surface_curve.hpp"

namespace formwork {

/// Where points of a panel's border lie: on which loop, and how far round it.
struct BorderPlaces {
    std::vector<int> loop;         // per node, -1 inside
    std::vector<double> place;     // per node: its number in the loop
    std::vector<char> is_corner;   // per node
    std::vector<int> loop_size;

    /// @param care  in what counts as a corner, see corner_nodes
    BorderPlaces(const PanelPatch& patch, double care);
    /// Of a point on the border: a node's number, or that of the edge's first node and a half.
    double place_of(const CurvePoint& q) const;
};

/// Corners of the two pieces of a disk that a curve from a to b divides, the larger number: those left on each side, and
/// the curve's two ends.
int most_corners_after(const PanelPatch& patch, const BorderPlaces& places, const CurvePoint& a, const CurvePoint& b);

/// What a curve would make of a panel, without cutting it.
struct CutPieces {
    int count = 0;
    double least_width = std::numeric_limits<double>::infinity();   // m: twice the largest distance to border and curve on a side, along edges
};
CutPieces cut_pieces(const PanelPatch& patch, const Curve& curve);

/// The pieces that a curve makes of a panel, each with its own topology; junctions are not marked.
/// None when the curve crosses itself.
std::vector<PanelPatch> split_pieces(const PanelPatch& patch, const Curve& curve);

}  // namespace formwork
