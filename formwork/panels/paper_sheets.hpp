#pragma once

#include <array>
#include <string>
#include <vector>

#include "formwork/panels/pattern.hpp"
#include "formwork/panels/polygon.hpp"

namespace formwork {

/// One sheet of paper: the part of the layout that is printed on it, and what is glued to its sides.
struct PaperSheet {
    std::string name;                       // "A1": row A, column 1
    Box window;                             // mm of the layout
    std::array<std::string, 4> neighbour;   // left, right, above, below; empty: nothing is glued there
    bool is_glued() const { return neighbour != std::array<std::string, 4>{}; }
};

/// The pieces as they are printed, which is not how they lie on the roll: paper has no grain, so pieces may be
/// turned, and those that fit on a sheet get no joint.
struct PaperLayout {
    Vector2d paper{210, 297};   // mm
    std::vector<PatternPiece> pieces;   // turned where that saves joints
    std::vector<Placement> placement;   // per piece
    std::vector<PaperSheet> sheets;
    std::vector<Box> left_out;          // windows of the sheets inside pieces that would be blank and are not printed
    Vector2d size{0, 0};        // of the whole layout, mm
};

inline constexpr double page_margin = 10;     // mm that home printers cannot reach
inline constexpr double sheet_overlap = 10;   // mm that neighbouring sheets share, to be glued

/// Sheets of `paper`, not A0. A piece that would fit askew is turned. Pieces larger than a sheet are glued from grids
/// of overlapping sheets (lay_on_grids); the others are packed whole on sheets of their own.
PaperLayout lay_on_sheets(const std::vector<PatternPiece>& pieces, const PanelParams& params, Paper paper);

/// All pieces on one page for a plotter: nested on the width of A0 (841 mm less margins) when they fit, else as
/// wide as the roll.
PaperLayout lay_on_plotter(const std::vector<PatternPiece>& pieces, const PanelParams& params);

}  // namespace formwork
