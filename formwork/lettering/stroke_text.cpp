#include "formwork/lettering/stroke_text.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "formwork/lettering/stroke_glyphs.hpp"

namespace formwork {
namespace {

using arcsim::Vector2d;
using Line = std::vector<Vector2d>;

constexpr double capital = 10;   // glyph units
constexpr double gap = 2.5;      // glyph units between two letters

char32_t next_code(std::string_view s, size_t& i) {
    const auto byte = [&](size_t k) { return k < s.size() ? static_cast<unsigned char>(s[k]) : 0u; };
    const unsigned c = byte(i);
    if (c < 0x80) return s[i++];
    if ((c >> 5) == 6) {
        const char32_t code = (c & 0x1f) << 6 | (byte(i + 1) & 0x3f);
        i += 2;
        return code;
    }
    if ((c >> 4) == 14) {
        const char32_t code = (c & 0x0f) << 12 | (byte(i + 1) & 0x3f) << 6 | (byte(i + 2) & 0x3f);
        i += 3;
        return code;
    }
    ++i;
    return 0;
}

Line arc(const Vector2d& centre, double rx, double ry, double from, double to) {
    const int n = std::max(4, static_cast<int>(std::abs(to - from) / 15));
    Line line;
    for (int k = 0; k <= n; ++k) {
        const double a = (from + (to - from) * k / n) * M_PI / 180;
        line.push_back(centre + Vector2d(rx * std::cos(a), ry * std::sin(a)));
    }
    return line;
}

/// The letter's polylines in glyph units.
std::vector<Line> glyph_lines(const Glyph& g) {
    std::vector<Line> lines;
    std::istringstream in(g.strokes);
    Vector2d pen(0, 0);
    const auto read = [&] {
        Vector2d p;
        in >> p.x() >> p.y();
        return p;
    };
    for (char command; in >> command;) {
        if (command == 'M') {
            lines.push_back({pen = read()});
        } else if (command == 'L') {
            lines.back().push_back(pen = read());
        } else if (command == 'Q') {
            const Vector2d from = pen, control = read(), to = read();
            for (int k = 1; k <= 8; ++k) {
                const double t = k / 8.0, s = 1 - t;
                lines.back().push_back(s * s * from + 2 * s * t * control + t * t * to);
            }
            pen = to;
        } else {
            const Vector2d centre = read(), radii = read(), angles = read();
            lines.push_back(arc(centre, radii.x(), radii.y(), angles.x(), angles.y()));
        }
    }
    return lines;
}

}  // namespace

StrokeText stroke_text(std::string_view utf8) {
    StrokeText text;
    double pen = 0;   // glyph units
    for (size_t i = 0; i < utf8.size();) {
        const Glyph& g = find_glyph(next_code(utf8, i));
        for (Line& line : glyph_lines(g)) {
            if (line.size() < 2) continue;
            for (Vector2d& p : line) p = (p + Vector2d(pen, 0)) / capital;
            text.lines.push_back(std::move(line));
        }
        pen += g.width + gap;
    }
    text.width = std::max(0.0, pen - gap) / capital;
    return text;
}

}  // namespace formwork
