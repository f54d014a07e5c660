#pragma once

#include "formwork/panels/paper_sheets.hpp"

namespace formwork {

/// Pieces larger than a sheet, on grids of sheets that overlap and are glued.
struct GluedGrids {
    std::vector<PatternPiece> pieces;   // turned
    std::vector<Placement> placement;   // per piece, y from 0 downwards
    std::vector<PaperSheet> sheets;
    std::vector<Box> left_out;          // windows of blank sheets
    int rows = 0;                       // of sheets, all grids together
    double low = 0;                     // y of the lowest sheet's lower edge
};

/// Either all pieces nested on one grid, with the number of rows that needs the fewest sheets, or each on a grid of
/// its own, turned and moved to the place where it touches the fewest; whichever takes less paper.
/// @param room   printable part of a sheet, mm
GluedGrids lay_on_grids(const std::vector<PatternPiece>& large, const PanelParams& params, const Vector2d& room);

/// As params, for pieces on paper of this width: close together and turned as it fits.
PanelParams paper_nesting(const PanelParams& params, double width);

inline constexpr double between_sheets = 20;  // mm of the layout, so that no sheet shows what is on another

}  // namespace formwork
