#pragma once

#include "formwork/report/image.hpp"
#include "formwork/report/paint.hpp"

namespace formwork {

/// Width in px that the legend of `paint` needs at the right border; 0 without a legend.
double legend_width(const Paint& paint);

/// Draws the colour bar or the swatches into the column that begins at x.
void draw_legend(Image& image, const Paint& paint, double x, double y0, double y1);

/// Title and note in the upper left corner.
double heading_width(const std::string& title, const std::string& note);  // px
void draw_heading(Image& image, const std::string& title, const std::string& note);

}  // namespace formwork
