#pragma once

#include "formwork/panels/pattern.hpp"

namespace formwork {

/// Lays the pieces on a roll, warp along it: turned by 0° or 180°, with quarter_turns also by 90° and 270°.
/// Bottom-left on true outlines: a raster of the grown outlines finds the place of every piece that
/// lengthens the marker least, several orders of pieces are tried and the shortest marker is kept.
/// Pieces keep nest_gap_mm between them; that none overlap is checked on the exact outlines.
/// @throws InputError  a piece is wider than the roll, with its number and width
Nest nest_pieces(const std::vector<PatternPiece>& pieces, const PanelParams& params);

}  // namespace formwork
