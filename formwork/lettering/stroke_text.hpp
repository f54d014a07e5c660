#pragma once

#include <string_view>
#include <vector>

#include "arcsim/base/types.hpp"

namespace formwork {

/// One line of text as strokes of a pen, as on a technical drawing: for machines that have no fonts and for
/// pictures. ASCII, some Greek and the signs that units need; a character that it does not know is a box.
/// Lengths are in heights of a capital letter; the base line starts at the origin, y points up.
struct StrokeText {
    std::vector<std::vector<arcsim::Vector2d>> lines;   // open polylines, two points or more
    double width = 0;
};
StrokeText stroke_text(std::string_view utf8);

}  // namespace formwork
