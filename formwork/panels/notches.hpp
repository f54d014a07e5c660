#pragma once

#include <vector>

#include "formwork/panels/panel_set.hpp"

namespace formwork {

enum class NotchShape { slit, tee, vee };

/// What tells the seams of a bag apart: the strokes of a seam's first notch, in their order along the seam, and
/// how far from its start it stands. The later notches are single slits.
struct NotchStyle {
    std::vector<NotchShape> strokes{NotchShape::slit};
    double first = 0.5;   // distance of the first notch from the start, in notch intervals; never 1
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
/// row read backwards never fits and no piece can be sewn in reverse. No two seams have the same style; the
/// shortest seams get the narrowest. Panels lie flat already: notches are no further apart than
/// params.notch_spacing_mm on the cloth, nor on the surface.
void place_notches(PanelSet& set);

/// Middle of stroke i of n from the notch's own place, mm along the seam.
double stroke_offset_mm(const NotchStyle& style, std::size_t stroke);

}  // namespace formwork
