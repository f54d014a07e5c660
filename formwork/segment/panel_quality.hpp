#pragma once

#include "formwork/segment/panel_outline.hpp"
#include "formwork/segment/panel_split.hpp"

namespace formwork {

/// What is known about one panel, or about a panel that a cut or a join would make.
struct PanelQuality {
    bool is_disk = false;
    double area = 0;             // m²
    Vector3d centre = Vector3d::Zero();   // of the area, m
    double estimate = 0;         // of the stretch, before flattening
    bool is_flattened = false;   // p95 is measured, not derived from the estimate
    double p95 = 0;              // stretch of the flat pattern that 95 % of the area stays below
    bool has_failed = false;     // it could not be laid flat without folds: p95 is a guess
    bool overlaps = false;       // its flat outline crosses itself: it cannot be cut from one sheet
    double solidity = 1;         // area of the flat piece over that of its convex hull: snakes and hooks waste cloth
    int corners = 0;
    double width = 0;            // m
    OutlineShape shape;
};

/// Everything but the flat pattern; the stretch is the estimate times `calibration`.
PanelQuality look_at(const PanelPatch& patch, const SplitRules& rules, double calibration);

/// Replaces the derived stretch by that of a flattening, and looks whether the outline crosses itself; not for panels whose
/// estimate is beyond what is believed.
void measure_flat(const PanelPatch& patch, const SplitRules& rules, PanelQuality& q);

/// Measured stretch over estimate; a typical value for panels that were not laid flat.
double calibration_of(const PanelQuality& q);

/// How much stretch beyond the bound a panel holds: area times the relative excess, m². An outline that crosses itself and
/// corners beyond max_corners count as stretch does.
double excess_of(const PanelQuality& q, const SplitRules& rules);

/// A disk with few corners that lies flat within the bound.
bool keeps_bounds(const PanelQuality& q, const SplitRules& rules);

/// A hook or snake: cloth is wasted around it, and it is hard to sew in.
constexpr double least_solidity = 0.65;

/// The same panel as good as a flattening could find it.
PanelQuality at_best(PanelQuality q);

/// What a panel costs in a layout, in panels: 1, and more for bounds that are not kept, thin tips, inner corners
/// and hooks.
double panel_cost(const PanelQuality& q, const SplitRules& rules);

}  // namespace formwork
