#include "formwork/report/chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "arcsim/base/text.hpp"
#include "formwork/report/colour.hpp"
#include "formwork/report/paint.hpp"
#include "formwork/report/stroke_font.hpp"

namespace formwork {
namespace {

constexpr int width = 1100, height = 720;
constexpr double left = 110, right = 850, top = 80, bottom = 630;   // of the plot, px

/// Where the values of one axis lie, and the ticks along it.
class Range {
public:
    explicit Range(AxisScale scale) : scale_(scale) {
        if (scale == AxisScale::from_zero) low_ = high_ = 0;
    }
    void include(double v) {
        low_ = std::min(low_, v);
        high_ = std::max(high_, v);
    }
    /// After the last value: leaves room where there is only one.
    void close() {
        if (!(low_ <= high_)) low_ = scale_ == AxisScale::logarithmic ? 1 : 0, high_ = 1;
        if (low_ < high_) return;
        if (scale_ == AxisScale::logarithmic) low_ /= 2, high_ *= 2;
        else high_ += high_ == 0 || scale_ == AxisScale::from_zero ? 1 : 0.1 * std::abs(high_);
    }
    double share(double v) const {
        return scale_ == AxisScale::logarithmic ? std::log(v / low_) / std::log(high_ / low_) : (v - low_) / (high_ - low_);
    }
    std::vector<double> ticks() const {
        if (scale_ != AxisScale::logarithmic) return round_ticks(low_, high_, 8);
        std::vector<double> ticks;
        const bool many = high_ / low_ > 100;      // powers of ten alone
        for (double decade = std::pow(10, std::floor(std::log10(low_))); decade <= high_; decade *= 10)
            for (double v : {decade, 2 * decade, 5 * decade})
                if (v >= low_ * (1 - 1e-9) && v <= high_ * (1 + 1e-9) && (v == decade || !many)) ticks.push_back(v);
        return ticks;
    }
    std::string label(double v, const std::vector<double>& ticks) const {
        if (scale_ == AxisScale::logarithmic) return arcsim::format_short(v, 3);
        return tick_label(v, ticks.size() > 1 ? ticks[1] - ticks[0] : 1);
    }

private:
    AxisScale scale_;
    double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

}  // namespace

Image line_chart(const std::vector<ChartSeries>& series, const std::string& title, const ChartAxis& x_axis,
                 const ChartAxis& y_axis) {
    Range x_range(x_axis.scale), y_range(y_axis.scale);
    for (const ChartSeries& s : series) {
        for (double x : s.x) x_range.include(x);
        for (double y : s.y) y_range.include(y);
    }
    x_range.close();
    y_range.close();
    const auto px = [&](double x) { return left + (right - left) * x_range.share(x); };
    const auto py = [&](double y) { return bottom - (bottom - top) * y_range.share(y); };

    Image image(width, height);
    const Rgb grid{0.88, 0.88, 0.9}, axis{0.3, 0.3, 0.33};
    TextStyle small;
    small.size_px = 17;
    const std::vector<double> xs = x_range.ticks(), ys = y_range.ticks();
    for (double x : xs) {
        draw_line(image, px(x), top, px(x), bottom, 1, grid);
        small.anchor = Anchor::middle;
        draw_text(image, px(x), bottom + 24, x_range.label(x, xs), small);
    }
    for (double y : ys) {
        draw_line(image, left, py(y), right, py(y), 1, grid);
        small.anchor = Anchor::right;
        draw_text(image, left - 10, py(y) + 6, y_range.label(y, ys), small);
    }
    draw_line(image, left, top, left, bottom, 1.6, axis);
    draw_line(image, left, bottom, right, bottom, 1.6, axis);
    TextStyle label;
    label.size_px = 19;
    draw_text(image, left - 60, top - 16, y_axis.label, label);
    label.anchor = Anchor::right;
    draw_text(image, right, bottom + 58, x_axis.label, label);
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
