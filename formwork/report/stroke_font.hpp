#pragma once

#include <string_view>

#include "formwork/report/image.hpp"

namespace formwork {

/// Lettering of this project's own: single strokes with round ends, as on a technical drawing.
/// ASCII, some Greek and the signs that units need; a character it does not know is drawn as a
/// small box.
enum class Anchor { left, middle, right };

struct TextStyle {
    double size_px = 18;  // height of a capital letter is 0.7 of it
    double weight = 1;    // stroke width relative to the regular cut
    Rgb colour{0.13, 0.14, 0.16};
    Anchor anchor = Anchor::left;
    double halo_px = 0;  // width of a white rim that keeps lettering legible on a picture
};

double text_width(std::string_view utf8, const TextStyle& style);

/// Draws one line of text; (x, y) is the baseline's point named by the anchor, px from the top
/// left.
void draw_text(Image& image, double x, double y, std::string_view utf8, const TextStyle& style);

/// An antialiased straight stroke with round ends, and filled shapes, px.
void draw_line(Image& image, double x0, double y0, double x1, double y1, double width,
               const Rgb& colour);
void fill_disc(Image& image, double x, double y, double radius, const Rgb& colour);
void fill_box(Image& image, double x0, double y0, double x1, double y1, const Rgb& colour);

}  // namespace formwork
