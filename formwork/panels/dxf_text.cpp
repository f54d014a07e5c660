#include "formwork/panels/dxf_text.hpp"

#include <cmath>

namespace formwork {

std::string ascii(const std::string& text) {
    std::string out;
    for (char c : text) {
        if (c >= 32 && c < 127) out += c;
        else if ((c & 0xC0) != 0x80) out += '_';   // once per character of UTF-8
    }
    return out;
}

void DxfText::real(int code, double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.*f", decimals_, value);
    if (std::string(text).find_first_of("123456789") == std::string::npos && text[0] == '-') return pair(code, text + 1);
    pair(code, text);
}

void DxfText::line(const std::string& layer, const Vector2d& a, const Vector2d& b) {
    pair(0, "LINE");
    pair(8, layer);
    point_at(a, 10);
    point_at(b, 11);
}

void DxfText::point(const std::string& layer, const Vector2d& p) {
    pair(0, "POINT");
    pair(8, layer);
    point_at(p);
}

void DxfText::polyline(const std::string& layer, const Line& line, bool closed) {
    pair(0, "POLYLINE");
    pair(8, layer);
    pair(66, 1);   // vertices follow
    point_at({0, 0});
    pair(70, closed ? 1 : 0);
    for (const Vector2d& p : line) {
        pair(0, "VERTEX");
        pair(8, layer);
        point_at(p);
    }
    pair(0, "SEQEND");
    pair(8, layer);
}

void DxfText::text(const std::string& layer, const Vector2d& at, double height, double angle, const std::string& text, bool centred) {
    pair(0, "TEXT");
    pair(8, layer);
    point_at(at);
    real(40, height);
    pair(1, ascii(text));
    if (std::abs(angle) > 1e-9) real(50, angle * 180 / M_PI);
    if (centred) {
        pair(72, 1);
        point_at(at, 11);
    }
}

}  // namespace formwork
