#include "formwork/report/chart.hpp"

#include <algorithm>
#include <cmath>

#include "formwork/report/colour.hpp"
#include "formwork/report/paint.hpp"
#include "formwork/report/stroke_font.hpp"

namespace formwork {
namespace {

constexpr int width = 1100, height = 720;
constexpr double left = 110, right = 850, top = 80, bottom = 630;   // of the plot, px

}  // namespace

Image line_chart(const std::vector<ChartSeries>& series, const std::string& title, const std::string& x_label,
                 const std::string& y_label) {
    double x_max = 0, y_max = 0, y_min = 0;
    for (const ChartSeries& s : series)
        for (size_t i = 0; i < s.x.size(); ++i) {
            x_max = std::max(x_max, s.x[i]);
            y_max = std::max(y_max, s.y[i]);
            y_min = std::min(y_min, s.y[i]);
        }
    if (!(x_max > 0)) x_max = 1;
    if (!(y_max > y_min)) y_max = y_min + 1;
    const auto px = [&](double x) { return left + (right - left) * x / x_max; };
    const auto py = [&](double y) { return bottom - (bottom - top) * (y - y_min) / (y_max - y_min); };

    Image image(width, height);
    const Rgb grid{0.88, 0.88, 0.9}, axis{0.3, 0.3, 0.33};
    TextStyle small;
    small.size_px = 17;
    const std::vector<double> xs = round_ticks(0, x_max, 8), ys = round_ticks(y_min, y_max, 8);
    const auto step = [](const std::vector<double>& t) { return t.size() > 1 ? t[1] - t[0] : 1; };
    for (double x : xs) {
        draw_line(image, px(x), top, px(x), bottom, 1, grid);
        small.anchor = Anchor::middle;
        draw_text(image, px(x), bottom + 24, tick_label(x, step(xs)), small);
    }
    for (double y : ys) {
        draw_line(image, left, py(y), right, py(y), 1, grid);
        small.anchor = Anchor::right;
        draw_text(image, left - 10, py(y) + 6, tick_label(y, step(ys)), small);
    }
    draw_line(image, left, top, left, bottom, 1.6, axis);
    draw_line(image, left, bottom, right, bottom, 1.6, axis);
    TextStyle label;
    label.size_px = 19;
    draw_text(image, left - 60, top - 16, y_label, label);
    label.anchor = Anchor::right;
    draw_text(image, right, bottom + 58, x_label, label);
    TextStyle heading;
    heading.size_px = 24;
    heading.weight = 1.3;
    draw_text(image, left - 60, 36, title, heading);

    double row = top + 14;
    for (const ChartSeries& s : series) {
        const Rgb colour = class_colour(s.colour);
        for (size_t i = 0; i < s.x.size(); ++i) {
            if (s.line && i > 0) draw_line(image, px(s.x[i - 1]), py(s.y[i - 1]), px(s.x[i]), py(s.y[i]), 2.4, colour);
            if (s.dots) fill_disc(image, px(s.x[i]), py(s.y[i]), 4, colour);
        }
        if (s.name.empty()) continue;
        if (s.line) draw_line(image, right + 24, row - 6, right + 56, row - 6, 3, colour);
        if (s.dots) fill_disc(image, right + 40, row - 6, 4, colour);
        small.anchor = Anchor::left;
        draw_text(image, right + 66, row, s.name, small);
        row += 28;
    }
    return image;
}

}  // namespace formwork
