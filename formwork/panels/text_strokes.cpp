#include "formwork/panels/text_strokes.hpp"

#include <cmath>

#include "formwork/lettering/stroke_text.hpp"

namespace formwork {

namespace {

/// A point or the dot of an i is drawn as a ring: a machine would not see a stroke of its length.
void make_visible(Line& line) {
    constexpr double dot = 0.04, radius = 0.06;   // of a capital's height
    if ((line.back() - line.front()).norm() > dot || line.size() > 2) return;
    const Vector2d c = line.front() + Vector2d(0, radius);
    line.clear();
    for (int k = 0; k <= 8; ++k) line.push_back(c + radius * Vector2d(std::sin(k * M_PI / 4), -std::cos(k * M_PI / 4)));
}

}  // namespace

std::vector<Line> text_strokes(const TextMark& mark) {
    StrokeText text = stroke_text(mark.text);
    const Vector2d along(std::cos(mark.angle), std::sin(mark.angle)), up(-along.y(), along.x());
    for (Line& line : text.lines) {
        make_visible(line);
        for (Vector2d& p : line) p = mark.at + mark.height * ((p.x() - text.width / 2) * along + p.y() * up);
    }
    return std::move(text.lines);
}

}  // namespace formwork
