#pragma once

#include <array>
#include <vector>

#include "formwork/panels/flat_panel.hpp"
#include "formwork/panels/panel_params.hpp"
#include "formwork/segment/segmentation.hpp"

namespace formwork {

/// One side of a seam: a chain of outline vertices of one panel, in the direction of the seam's chain.
struct SeamSide {
    int panel = -1;
    std::vector<int> vertex;   // local vertices of the panel, one per node of the seam
    double length = 0;         // flat, m
};

/// One seam as cloth; number s of the set is seam s of the segmentation.
struct PanelSeam {
    std::array<SeamSide, 2> side;   // side[0] left of the chain; side[1].panel is -1 for a rim
    double rest_length = 0;         // on the surface, m
    std::vector<double> notch_rest; // where notches divide the seam on the surface: ascending shares of rest_length
    std::vector<double> notch;      // the same points as shares of the flat length, the same on both sides
    int style = 0;                  // see NotchStyle; no two seams have the same
    double mismatch = 0;            // |a - b| / max(a, b) of the whole seam
    double local_mismatch = 0;      // the largest |a - b| between notches over the longer one
    bool is_rim() const { return side[1].panel < 0; }
};

/// What summary.json says about the stage.
struct PanelMetrics {
    int count = 0;
    double cloth_area_m2 = 0;             // flat, without allowances
    double rest_area_m2 = 0;              // of the cut surface
    double max_stretch_distortion = 0, mean_stretch_distortion = 0;
    int flips = 0, overlaps = 0;
    double max_seam_length_mismatch = 0;
};

/// All pieces of a bag, flat, with their seams.
struct PanelSet {
    PanelParams params;
    std::vector<FlatPanel> panels;
    std::vector<PanelSeam> seams;
    PanelMetrics metrics;
};

/// Lays every panel flat, turns it to its grain, gives both sides of every seam the same length between
/// notches, and measures what that costs.
/// @throws InputError      a panel that is no disk; a seam whose sides differ beyond params.max_seam_mismatch
/// @throws NumericalError  a panel that stretches beyond params.max_distortion, or overlaps itself when flat; each of
///                         these with the panel's or seam's printed number and what to change
PanelSet make_panels(const Segmentation& segmentation, const PanelParams& params);

/// Measures panels and seams again from their flat coordinates: for a set that was read back from files.
void measure_panels(PanelSet& set, const Segmentation& segmentation);

/// Flat positions of one side of a seam, m.
std::vector<Vector2d> flat_chain(const PanelSet& set, const SeamSide& side);

/// "P03", "S07", "R02": how panels, seams and rims are called on every sheet.
std::string panel_name(int panel);
std::string seam_name(const PanelSet& set, int seam);

}  // namespace formwork
