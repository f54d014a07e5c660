#include "formwork/report/paint.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace formwork {
namespace {

std::vector<double> sorted_finite(const std::vector<double>& values) {
    std::vector<double> v;
    for (const double x : values)
        if (std::isfinite(x)) v.push_back(x);
    std::sort(v.begin(), v.end());
    return v;
}

double round_step(double range, int target) {
    const double raw = range / std::max(target, 1);
    const double power = std::pow(10, std::floor(std::log10(raw)));
    for (const double m : {1.0, 2.0, 2.5, 5.0})
        if (m * power >= raw * 0.85) return m * power;
    return 10 * power;
}

void mark_clipping(ColourScale& s, const std::vector<double>& v) {
    const double slack = 1e-9 * (s.high - s.low);
    s.below = !v.empty() && v.front() < s.low - slack;
    s.above = !v.empty() && v.back() > s.high + slack;
}

}  // namespace

ColourScale sequential_scale(const std::vector<double>& values, std::string title,
                             std::string unit) {
    ColourScale s{ColourMap::sequential, 0, 1, std::move(title), std::move(unit)};
    const std::vector<double> v = sorted_finite(values);
    if (v.empty()) return s;
    double low = v[static_cast<size_t>(0.005 * (v.size() - 1))],
           high = v[static_cast<size_t>(0.995 * (v.size() - 1))];
    const double least = std::max(1e-6, 1e-4 * std::max(std::abs(low), std::abs(high)));
    if (high - low < least) high = low + least;
    const double step = round_step(high - low, 20);
    s.low = step * std::floor(low / step + 1e-9);
    s.high = step * std::ceil(high / step - 1e-9);
    mark_clipping(s, v);
    return s;
}

ColourScale diverging_scale(const std::vector<double>& values, std::string title, std::string unit,
                            double centre) {
    std::vector<double> size;
    for (const double x : values)
        if (std::isfinite(x)) size.push_back(std::abs(x - centre));
    std::sort(size.begin(), size.end());
    double reach = size.empty() ? 1 : size[static_cast<size_t>(0.995 * (size.size() - 1))];
    reach = std::max(reach, 1e-6);
    const double step = round_step(reach, 10);
    reach = step * std::ceil(reach / step - 1e-9);
    ColourScale s{ColourMap::diverging, centre - reach, centre + reach, std::move(title),
                  std::move(unit)};
    mark_clipping(s, sorted_finite(values));
    return s;
}

std::vector<double> round_ticks(double low, double high, int target) {
    std::vector<double> ticks;
    if (!(high > low)) return {low};
    const double step = round_step(high - low, target);
    for (double k = std::ceil(low / step - 1e-6); k * step <= high + 1e-6 * step; ++k)
        ticks.push_back(k * step);
    return ticks;
}

std::string tick_label(double value, double step) {
    if (std::abs(value) < 1e-9 * step) return "0";
    char text[32];
    const double size = std::max(std::abs(value), step);
    if (size >= 1e6 || size < 1e-4) {
        std::snprintf(text, sizeof text, "%.3g", value);
    } else {
        int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-6)));
        const double last = step * std::pow(10, decimals);
        if (std::abs(last - std::round(last)) > 1e-6) ++decimals;  // steps of 0.25
        std::snprintf(text, sizeof text, "%.*f", decimals, value);
    }
    std::string s(text);
    if (s[0] == '-') s = "\u2212" + s.substr(1);
    return s;
}

Paint paint_plain() {
    Paint p;
    p.colour.clear();
    return p;
}

Paint paint_values(const std::vector<double>& values, bool per_node, const ColourScale& scale) {
    Paint p;
    p.per_node = per_node;
    p.bar = scale;
    p.colour.reserve(values.size());
    for (const double v : values)
        p.colour.push_back(map_colour(scale.map, (v - scale.low) / (scale.high - scale.low)));
    return p;
}

Paint paint_classes(const std::vector<int>& class_of_face, const std::vector<Swatch>& classes,
                    std::string title) {
    Paint p;
    p.swatches = classes;
    p.swatches_title = std::move(title);
    const int n = static_cast<int>(classes.size());
    for (const int c : class_of_face)
        p.colour.push_back(c >= 0 && c < n ? classes[c].colour : Rgb{0.8, 0.8, 0.8});
    return p;
}

}  // namespace formwork
