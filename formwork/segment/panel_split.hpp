#pragma once

#include <optional>

#include "formwork/segment/field_graph.hpp"
#include "formwork/segment/panel_patch.hpp"
#include "formwork/segment/stretch_estimate.hpp"

namespace formwork {

/// What a good cut of a panel is.
struct SplitRules {
    DriftCost drift;
    double min_width = 0.03;        // m, of every piece
    double max_distortion = 0.05;   // of the flat pattern; sets what counts as flat enough
    int max_corners = 6;
    int trials = 24;                // seeds of candidate curves per panel
};

/// A curve that divides a panel, or opens it when it is no disk.
struct Split {
    Curve curve;            // in the patch's numbering; smoothed and snapped, ready to be inserted
    double length = 0;      // m
    double cost = 0;        // by (13)
    double gain = 0;        // fall of the stretch energy, m², per metre of cost
};

/// The best field-coherent curve that cuts the panel from border to border (a closed curve when there is no
/// border): the one that lowers the estimated stretch energy most per unit of cost (13), among those whose
/// pieces are wide enough and have few corners. A panel with several borders is first cut from one border to
/// another, one with handles along a curve that does not divide it.
/// Nothing when no curve along the field qualifies.
std::optional<Split> best_split(const PanelPatch& patch, const SurfaceField& field, const SplitRules& rules);

/// The shortest cut that brings a panel nearer to a disk whatever the field says: from border to border, along
/// a loop that does not divide, or, on a closed surface, between two far points (a slit).
std::optional<Split> plain_split(const PanelPatch& patch, const SurfaceField& field, const SplitRules& rules);

}  // namespace formwork
