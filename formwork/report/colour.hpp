#pragma once

#include <vector>

namespace formwork {

/// A colour as it is written to a PNG or to CSS: sRGB, each part 0..1.
struct Rgb {
    double r = 0, g = 0, b = 0;
};

Rgb mix(const Rgb& a, const Rgb& b, double t);  // t = 0: a, t = 1: b
Rgb scaled(const Rgb& c, double light);         // light multiplies linear light, not the code value

/// Maps for numbers. Both run evenly in Oklab lightness (Ottosson 2020), so that equal steps of the
/// number look equally large, in print and to colour-blind readers too.
///   sequential  dark violet -> teal -> light yellow: lightness 0.28 to 0.93
///   diverging   blue -> near white -> brown-red: lightness falls evenly to both sides of the
///   middle
enum class ColourMap { sequential, diverging };

/// @param t   position on the map; clamped to 0..1
Rgb map_colour(ColourMap map, double t);

/// Colours for classes: eight hues that stay apart for the common colour blindnesses (after the
/// choice of Okabe and Ito: orange, sky, green, yellow, blue, vermilion, purple, grey), then
/// lighter and darker turns of the same.
Rgb class_colour(int i);
constexpr int n_class_colours = 24;

/// One class colour index per item so that neighbours differ; the earliest free colour is taken, so
/// that maps with few classes keep to the eight distinct hues. @param neighbours   lists of
/// adjacent items, symmetric
std::vector<int> colour_classes(const std::vector<std::vector<int>>& neighbours);

}  // namespace formwork
