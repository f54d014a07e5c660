#pragma once

#include <cstdint>

namespace formwork {

/// One letter as strokes on a grid: baseline 0, capitals 10 high, small letters 7, descenders to
/// -3.
///   M x y    begin a stroke          L x y    straight to
///   Q a b x y  parabola with control point (a, b)     E x y rx ry from to   arc about (x, y),
///   degrees, own stroke
struct Glyph {
    char32_t code;
    double width;
    const char* strokes;
};

const Glyph& find_glyph(char32_t code);  // the box when the letter is not in the table

}  // namespace formwork
