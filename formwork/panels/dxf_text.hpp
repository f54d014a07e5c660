#pragma once

#include <array>
#include <cstdio>
#include <string>

#include "formwork/panels/pattern.hpp"

namespace formwork {

/// Builds the group codes of a DXF R12 file. Coordinates in mm; text is reduced to ASCII.
class DxfText {
public:
    explicit DxfText(int decimals) : decimals_(decimals) {}

    void pair(int code, const std::string& value) {
        char text[8];
        std::snprintf(text, sizeof text, "%3d\n", code);
        out_ += text + value + "\n";
    }
    void pair(int code, int value) { pair(code, std::to_string(value)); }
    void real(int code, double value);

    void point_at(const Vector2d& p, int first = 10) {
        real(first, p.x());
        real(first + 10, p.y());
    }
    void line(const std::string& layer, const Vector2d& a, const Vector2d& b);
    void point(const std::string& layer, const Vector2d& p);
    void polyline(const std::string& layer, const Line& line, bool closed);
    void text(const std::string& layer, const Vector2d& at, double height, double angle, const std::string& text, bool centred);

    std::string finish() {
        pair(0, "EOF");
        return std::move(out_);
    }

private:
    std::string out_;
    int decimals_;
};

/// Only characters that every reader of R12 knows; others become '_'.
std::string ascii(const std::string& text);

}  // namespace formwork
