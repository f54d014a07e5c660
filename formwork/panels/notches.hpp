#pragma once

#include <vector>

#include "formwork/panels/panel_set.hpp"

namespace formwork {

enum class NotchShape { slit, tee, vee };

/// What tells the seams of a bag apart: the strokes of a seam's first notch, in their order along the seam. The later
/// notches are single slits.
struct NotchStyle {
    std::vector<NotchShape> strokes{NotchShape::slit};
    /// Distance from the first stroke to the last, mm.
    double width_mm() const;
};

/// Style number 0, 1, 2 ...: all rows of one stroke, of two, of three and so on, those of few strokes first. A row
/// and the same row backwards count once, for on the table they look alike: 3, 9, 27, 72, 198 ... styles of up to
/// 1, 2, 3, 4, 5 strokes.
NotchStyle notch_style(int style);
/// "double T", "slit V T".
std::string notch_words(const NotchStyle& style);

/// Chooses style and notch positions of every sewn seam. With m notches an interval is L / (m + first): the
/// first notch stands `first` intervals from the start, the last one a whole interval from the end, so the
/// row read backwards never fits and no piece can be sewn in reverse; of several `first` the one is taken whose
/// row is farthest from fitting. L is measured edge by edge where the seam is longest: on the surface or on either
/// piece, which lie flat already. So no two notches are further apart than params.notch_spacing_mm on any of them.
/// No two seams have the same style; the shortest seams get the narrowest.
void place_notches(PanelSet& set, const Segmentation& s);

/// Whether notches of the flat pieces are further apart than params.notch_spacing_mm; PanelSeam::notch is up to date.
bool notches_too_far_apart(const PanelSet& set);

/// Middle of stroke i of n from the notch's own place, mm along the seam.
double stroke_offset_mm(const NotchStyle& style, std::size_t stroke);

}  // namespace formwork
