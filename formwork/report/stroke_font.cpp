#include "formwork/report/stroke_font.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "formwork/lettering/stroke_text.hpp"

namespace formwork {
namespace {

constexpr double capital_per_size = 0.7;
constexpr double stroke_width = 0.115;  // of a capital's height, regular cut

struct Stroke {
    double x0, y0, x1, y1;
};

double distance(const Stroke& s, double px, double py) {
    const double dx = s.x1 - s.x0, dy = s.y1 - s.y0, l2 = dx * dx + dy * dy;
    const double t = l2 > 0 ? std::clamp(((px - s.x0) * dx + (py - s.y0) * dy) / l2, 0.0, 1.0) : 0;
    return std::hypot(px - s.x0 - t * dx, py - s.y0 - t * dy);
}

/// Blends the union of the strokes once, so that joints do not show.
void paint_strokes(Image& image, const std::vector<Stroke>& strokes, double width,
                   const Rgb& colour) {
    if (strokes.empty()) return;
    const double r = width / 2;
    double lo_x = 1e9, lo_y = 1e9, hi_x = -1e9, hi_y = -1e9;
    for (const Stroke& s : strokes) {
        lo_x = std::min({lo_x, s.x0, s.x1}), hi_x = std::max({hi_x, s.x0, s.x1});
        lo_y = std::min({lo_y, s.y0, s.y1}), hi_y = std::max({hi_y, s.y0, s.y1});
    }
    const int x0 = std::max(0, static_cast<int>(std::floor(lo_x - r - 1)));
    const int y0 = std::max(0, static_cast<int>(std::floor(lo_y - r - 1)));
    const int x1 = std::min(image.width - 1, static_cast<int>(std::ceil(hi_x + r + 1)));
    const int y1 = std::min(image.height - 1, static_cast<int>(std::ceil(hi_y + r + 1)));
    if (x1 < x0 || y1 < y0) return;
    std::vector<float> cover(static_cast<size_t>(x1 - x0 + 1) * (y1 - y0 + 1), 0.0f);
    for (const Stroke& s : strokes) {
        const int sx0 = std::max(x0, static_cast<int>(std::floor(std::min(s.x0, s.x1) - r - 1)));
        const int sx1 = std::min(x1, static_cast<int>(std::ceil(std::max(s.x0, s.x1) + r + 1)));
        const int sy0 = std::max(y0, static_cast<int>(std::floor(std::min(s.y0, s.y1) - r - 1)));
        const int sy1 = std::min(y1, static_cast<int>(std::ceil(std::max(s.y0, s.y1) + r + 1)));
        for (int y = sy0; y <= sy1; ++y)
            for (int x = sx0; x <= sx1; ++x) {
                float& c = cover[static_cast<size_t>(y - y0) * (x1 - x0 + 1) + (x - x0)];
                c = std::max(c, static_cast<float>(
                                    std::clamp(0.5 + r - distance(s, x + 0.5, y + 0.5), 0.0, 1.0)));
            }
    }
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x)
            image.blend(x, y, colour,
                        cover[static_cast<size_t>(y - y0) * (x1 - x0 + 1) + (x - x0)]);
}

}  // namespace

double text_width(std::string_view utf8, const TextStyle& style) {
    return stroke_text(utf8).width * capital_per_size * style.size_px;
}

void draw_text(Image& image, double x, double y, std::string_view utf8, const TextStyle& style) {
    const double capital = capital_per_size * style.size_px;
    const StrokeText text = stroke_text(utf8);
    const double width = text.width * capital;
    const double pen = x - (style.anchor == Anchor::left    ? 0
                            : style.anchor == Anchor::right ? width
                                                            : width / 2);
    std::vector<Stroke> all;
    for (const auto& line : text.lines)
        for (size_t k = 0; k + 1 < line.size(); ++k)
            all.push_back({pen + line[k].x() * capital, y - line[k].y() * capital,
                           pen + line[k + 1].x() * capital, y - line[k + 1].y() * capital});
    const double stroke = std::max(1.0, stroke_width * style.weight * capital);
    if (style.halo_px > 0) paint_strokes(image, all, stroke + 2 * style.halo_px, {1, 1, 1});
    paint_strokes(image, all, stroke, style.colour);
}

void draw_line(Image& image, double x0, double y0, double x1, double y1, double width,
               const Rgb& colour) {
    paint_strokes(image, {{x0, y0, x1, y1}}, width, colour);
}

void fill_disc(Image& image, double x, double y, double radius, const Rgb& colour) {
    paint_strokes(image, {{x, y, x, y}}, 2 * radius, colour);
}

void fill_box(Image& image, double x0, double y0, double x1, double y1, const Rgb& colour) {
    for (int y = static_cast<int>(std::floor(y0)); y < std::ceil(y1); ++y)
        for (int x = static_cast<int>(std::floor(x0)); x < std::ceil(x1); ++x) {
            const double cx = std::min(x + 1.0, x1) - std::max<double>(x, x0);
            const double cy = std::min(y + 1.0, y1) - std::max<double>(y, y0);
            image.blend(x, y, colour, std::max(0.0, cx) * std::max(0.0, cy));
        }
}

}  // namespace formwork
