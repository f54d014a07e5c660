#pragma once

#include "formwork/panels/pattern.hpp"

namespace formwork {

/// Sew line, seams of its edges, cut line, hem folds of one panel.
PatternPiece outline_piece(const PanelSet& set, int panel);

/// Allowance of a seam or rim, mm.  @throws InputError in check_allowances when an override names no seam
double allowance_mm(const PanelSet& set, int seam);
void check_allowances(const PanelSet& set);

/// Notches on both ends of the allowance, at the same share of the seam's length as on the other piece.
void add_notches(const PanelSet& set, PatternPiece& piece);

/// Grain arrow, title block and the seams' names.
void add_labels(const PanelSet& set, const PatternInfo& info, PatternPiece& piece);

/// The box around a line of text, turned as the text is, with some clearance.
Line text_box(const TextMark& text);

/// The chain's point at a share of its length, and the unit tangent there.
struct ChainPoint {
    Vector2d at, tangent;
};
ChainPoint chain_point(const Line& chain, double share);

}  // namespace formwork
