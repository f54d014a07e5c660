#pragma once

#include <memory>
#include <optional>

#include "formwork/flatten/flatten.hpp"
#include "formwork/segment/effort.hpp"
#include "formwork/segment/field_graph.hpp"
#include "formwork/segment/panel_memory.hpp"
#include "formwork/segment/stretch_estimate.hpp"

namespace formwork {

/// What a good cut of a panel is.
struct SplitRules {
    DriftCost drift;
    double min_width = 0.03;        // m, of every piece
    double max_distortion = 0.05;   // of the flat pattern; sets what counts as flat enough
    int max_corners = 6;
    double care = 1;                // in what counts as a corner, see corner_nodes
    double clearance = 0;           // m: a flat piece with a narrower gap between two of its parts overlaps itself
    int trials = 24;                // seeds of candidate curves per panel
    double spacing = 0;             // m between the middles of different cuts; 0: a quarter of min_width
    FlattenParams flattening = FlattenParams::fast();   // by which panels are judged
    double believed = 2.5;          // times max_distortion: a larger estimate needs no flattening to be believed
    std::shared_ptr<PanelMemory> memory = std::make_shared<PanelMemory>();   // of panels judged so far; shared by copies
    std::shared_ptr<Effort> effort = std::make_shared<Effort>();             // spent so far; shared by copies
    double calibration = 1;         // stretch of the panel laid flat over its estimate: corrects the pieces' estimates
};

/// A curve that divides a panel, or opens it when it is no disk.
struct Split {
    Curve curve;            // in the patch's numbering; smoothed and snapped, ready to be inserted
    double length = 0;      // m
    double cost = 0;        // by (13)
    bool is_enough = false; // both pieces are expected to lie flat within max_distortion
};

/// Field-coherent curves that cut the panel from border to border (closed curves when there is no border), best
/// first: the cheapest by (13) of those that are expected to leave two panels flat enough; else the one that
/// lowers the estimated stretch energy most. Pieces must be wide enough and have few corners.
/// A panel with several borders is first cut from one border to another, one with handles along a curve that
/// does not divide it.
/// @param all   when given, every curve that was compared is added to it
/// @returns at most `count` curves that differ in where they run; none when no curve along the field qualifies
std::vector<Split> best_splits(const PanelPatch& patch, const SurfaceField& field, const SplitRules& rules, int count,
                               std::vector<CandidateCurve>* all = nullptr);

/// The shortest cut that brings a panel nearer to a disk whatever the field says: from border to border, along
/// a loop that does not divide, or, on a closed surface, between two far points (a slit).
std::optional<Split> plain_split(const PanelPatch& patch, const SurfaceField& field, const SplitRules& rules);

}  // namespace formwork
