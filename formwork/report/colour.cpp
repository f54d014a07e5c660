#include "formwork/report/colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace formwork {
namespace {

double to_code(double c) {
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

struct Lch {
    double lightness, chroma, hue_deg;  // polar Oklab
};

/// Oklab to linear sRGB; parts outside 0..1 are out of gamut.
Rgb oklab_to_linear(const Lch& c) {
    const double h = c.hue_deg * M_PI / 180;
    const double a = c.chroma * std::cos(h), b = c.chroma * std::sin(h);
    const double l = std::pow(c.lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = std::pow(c.lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = std::pow(c.lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
    return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool in_gamut(const Rgb& c) {
    constexpr double slack = 1e-3;
    return std::min({c.r, c.g, c.b}) >= -slack && std::max({c.r, c.g, c.b}) <= 1 + slack;
}

/// Takes chroma away until the screen can show the colour; lightness, which carries the number,
/// stays.
Rgb to_screen(Lch c) {
    while (c.chroma > 0 && !in_gamut(oklab_to_linear(c))) c.chroma -= 0.002;
    const Rgb linear = oklab_to_linear(c);
    return {to_code(std::clamp(linear.r, 0.0, 1.0)), to_code(std::clamp(linear.g, 0.0, 1.0)),
            to_code(std::clamp(linear.b, 0.0, 1.0))};
}

/// A smooth curve through equally spaced values (Catmull and Rom), so that the map shows no bands
/// of its own.
template <size_t n>
double through(const std::array<double, n>& v, double t) {
    const double s = std::clamp(t, 0.0, 1.0) * (n - 1);
    const int i = std::min(static_cast<int>(s), static_cast<int>(n) - 2);
    const double f = s - i;
    const double p1 = v[i], p2 = v[i + 1];
    const double p0 = i > 0 ? v[i - 1] : 2 * p1 - p2,
                 p3 = i + 2 < static_cast<int>(n) ? v[i + 2] : 2 * p2 - p1;
    return p1 + 0.5 * f *
                    (p2 - p0 + f * (2 * p0 - 5 * p1 + 4 * p2 - p3 + f * (3 * (p1 - p2) + p3 - p0)));
}

/// Lightness is a straight line; chroma and hue run through control points.
Lch sequential(double t) {
    constexpr std::array<double, 6> chroma{0.125, 0.120, 0.105, 0.100, 0.150, 0.180};
    constexpr std::array<double, 6> hue{305, 275, 238, 190, 142, 105};
    return {0.28 + 0.65 * t, through(chroma, t), through(hue, t)};
}

Lch diverging(double t) {
    const double side = std::abs(2 * t - 1);  // 0 in the middle, 1 at both ends
    return {0.96 - 0.52 * side, 0.135 * std::pow(side, 0.85), t < 0.5 ? 255.0 : 42.0};
}

std::array<Rgb, 256> tabulate(ColourMap map) {
    std::array<Rgb, 256> table;
    for (int i = 0; i < 256; ++i)
        table[i] =
            to_screen(map == ColourMap::sequential ? sequential(i / 255.0) : diverging(i / 255.0));
    return table;
}

}  // namespace

Rgb mix(const Rgb& a, const Rgb& b, double t) {
    return {std::lerp(a.r, b.r, t), std::lerp(a.g, b.g, t), std::lerp(a.b, b.b, t)};
}

Rgb scaled(const Rgb& c, double light) {
    // The code value follows linear light with an exponent close to 1/2.2 over the range that
    // shading uses.
    const double factor = std::pow(std::max(light, 0.0), 1 / 2.2);
    return {std::min(c.r * factor, 1.0), std::min(c.g * factor, 1.0), std::min(c.b * factor, 1.0)};
}

Rgb map_colour(ColourMap map, double t) {
    static const std::array<Rgb, 256> tables[2] = {tabulate(ColourMap::sequential),
                                                   tabulate(ColourMap::diverging)};
    const double s = std::isfinite(t) ? std::clamp(t, 0.0, 1.0) * 255 : 0;
    const int i = std::min(static_cast<int>(s), 254);
    const auto& table = tables[map == ColourMap::sequential ? 0 : 1];
    return mix(table[i], table[i + 1], s - i);
}

Rgb class_colour(int i) {
    static const std::array<Rgb, n_class_colours> table = [] {
        constexpr std::array<Lch, 8> hues{{{0.76, 0.15, 72},
                                           {0.75, 0.105, 233},
                                           {0.62, 0.12, 164},
                                           {0.90, 0.15, 103},
                                           {0.52, 0.135, 248},
                                           {0.62, 0.17, 42},
                                           {0.66, 0.125, 345},
                                           {0.62, 0.01, 250}}};
        std::array<Rgb, n_class_colours> t;
        for (int k = 0; k < 8; ++k) {
            const Lch c = hues[k];
            t[k] = to_screen(c);
            t[k + 8] = to_screen({std::min(c.lightness + 0.14, 0.95), c.chroma * 0.55, c.hue_deg});
            t[k + 16] = to_screen({c.lightness - 0.17, c.chroma * 0.9, c.hue_deg});
        }
        return t;
    }();
    return table[((i % n_class_colours) + n_class_colours) % n_class_colours];
}

std::vector<int> colour_classes(const std::vector<std::vector<int>>& neighbours) {
    const int n = static_cast<int>(neighbours.size());
    std::vector<int> colour(n, -1), uses(n_class_colours, 0);
    for (int i = 0; i < n; ++i) {
        std::array<bool, n_class_colours> taken{};
        for (const int j : neighbours[i])
            if (j >= 0 && j < n && j != i && colour[j] >= 0) taken[colour[j]] = true;
        // Spread over the eight distinct hues first: the least used free one.
        int best = -1;
        for (const int end : {8, n_class_colours}) {
            for (int c = 0; c < end; ++c)
                if (!taken[c] && (best < 0 || uses[c] < uses[best])) best = c;
            if (best >= 0) break;
        }
        colour[i] = best < 0 ? i % n_class_colours : best;
        ++uses[colour[i]];
    }
    return colour;
}

}  // namespace formwork
