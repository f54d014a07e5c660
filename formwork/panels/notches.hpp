#pragma once

#include "formwork/panels/panel_set.hpp"

namespace formwork {

enum class NotchShape { slit, tee, vee };

/// What tells the seams of a piece apart: the number of strokes and the shape of a seam's first notch, and
/// how far from its start it stands. The later notches are single slits.
struct NotchStyle {
    int strokes = 1;   // 1, 2 or 3
    NotchShape shape = NotchShape::slit;
    double first = 0.5;   // distance of the first notch from the start, in notch intervals; never 1
};
inline constexpr int n_notch_styles = 27;
NotchStyle notch_style(int style);

/// Chooses style and notch positions of every sewn seam. With m notches an interval is L / (m + first): the
/// first notch stands `first` intervals from the start, the last one a whole interval from the end, so the
/// row read backwards never fits and no piece can be sewn in reverse. Seams that share a panel differ in
/// style; so do all seams as long as there are no more than n_notch_styles. Panels lie flat already: notches
/// are no further apart than params.notch_spacing_mm on the cloth, nor on the surface.
void place_notches(PanelSet& set);

}  // namespace formwork
