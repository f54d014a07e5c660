#include "formwork/report/legend.hpp"

#include <algorithm>
#include <cmath>

#include "formwork/report/stroke_font.hpp"

namespace formwork {
namespace {

constexpr Rgb ink{0.13, 0.14, 0.16}, faint{0.45, 0.47, 0.5};
constexpr double margin = 28;
constexpr TextStyle heading_style{.size_px = 28, .weight = 1.2, .colour = ink},
    note_style{.size_px = 18, .colour = faint};

std::string bar_title(const ColourScale& s) {
    return s.unit.empty() || s.unit == "-" ? s.title : s.title + ", " + s.unit;
}

void draw_bar(Image& image, const ColourScale& s, double x, double y0, double y1) {
    const double w = 26;
    for (int y = static_cast<int>(y0); y < y1; ++y) {
        const double t = 1 - (y + 0.5 - y0) / (y1 - y0);
        fill_box(image, x, y, x + w, std::min(y + 1.0, y1), map_colour(s.map, t));
    }
    const std::vector<double> ticks = round_ticks(s.low, s.high, 6);
    const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1;
    for (const double v : ticks) {
        const double y = y1 - (y1 - y0) * (v - s.low) / (s.high - s.low);
        draw_line(image, x + w + 2, y, x + w + 7, y, 1.3, ink);
        draw_text(image, x + w + 16, y + 6, tick_label(v, step), {.size_px = 18});
    }
    // Values beyond the ends carry the end's colour; points say so.
    for (double k = 0; k < w / 2; k += 0.5) {
        if (s.above) fill_box(image, x + k, y0 - k, x + w - k, y0 - k + 0.5, map_colour(s.map, 1));
        if (s.below) fill_box(image, x + k, y1 + k - 0.5, x + w - k, y1 + k, map_colour(s.map, 0));
    }
}

}  // namespace

double legend_width(const Paint& paint) {
    double w = 0;
    if (paint.bar) w = std::max(120.0, text_width(bar_title(*paint.bar), {.size_px = 19}));
    for (const Swatch& s : paint.swatches)
        w = std::max(w, 34 + text_width(s.name, {.size_px = 18}));
    if (!paint.swatches.empty()) w = std::max(w, text_width(paint.swatches_title, {.size_px = 19}));
    return w > 0 ? w + 2 * margin : 0;
}

void draw_legend(Image& image, const Paint& paint, double x, double y0, double y1) {
    x += margin;
    double y = y0;
    if (paint.bar) {
        const double height = std::min(420.0, (y1 - y0) * (paint.swatches.empty() ? 0.8 : 0.5));
        if (paint.swatches.empty()) y = (y0 + y1 - height) / 2;
        draw_text(image, x, y, bar_title(*paint.bar), {.size_px = 19, .colour = ink});
        draw_bar(image, *paint.bar, x, y + 34, y + 34 + height);
        y += height + 90;
    }
    if (paint.swatches.empty()) return;
    const double line = std::min(30.0, (y1 - y - 40) / paint.swatches.size());
    if (!paint.bar) y = std::max(y0, (y0 + y1 - 40 - line * paint.swatches.size()) / 2);
    draw_text(image, x, y, paint.swatches_title, {.size_px = 19, .colour = ink});
    y += 22;
    for (const Swatch& s : paint.swatches) {
        fill_box(image, x, y, x + 22, y + line - 8, s.colour);
        draw_text(image, x + 34, y + (line - 8) / 2 + 6, s.name,
                  {.size_px = std::min(18.0, line * 0.7)});
        y += line;
    }
}

double heading_width(const std::string& title, const std::string& note) {
    return margin + std::max(text_width(title, heading_style), text_width(note, note_style));
}

void draw_heading(Image& image, const std::string& title, const std::string& note) {
    double y = 0;
    if (!title.empty()) draw_text(image, margin, y += 46, title, heading_style);
    if (!note.empty()) draw_text(image, margin, y += 32, note, note_style);
}

}  // namespace formwork
