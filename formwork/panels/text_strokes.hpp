#pragma once

#include "formwork/panels/pattern.hpp"

namespace formwork {

/// The lettering as lines where it stands on its piece, mm: for programs without the font.
std::vector<Line> text_strokes(const TextMark& mark);

}  // namespace formwork
