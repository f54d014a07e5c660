#include "formwork/panels/dxf_text.hpp"
#include "formwork/panels/pattern_files.hpp"
#include "formwork/panels/polygon.hpp"
#include "formwork/panels/text_strokes.hpp"

namespace formwork {
namespace {

constexpr std::array<std::pair<const char*, int>, 5> layers{{   // AutoCAD colours: red 1, green 3, blue 5, black 7
    {"CUT", 1}, {"SEW", 5}, {"NOTCH", 3}, {"GRAIN", 5}, {"LABEL", 7}}};

void write_tables(DxfText& dxf, const Box& box) {
    dxf.pair(0, "SECTION"), dxf.pair(2, "HEADER");
    dxf.pair(9, "$ACADVER"), dxf.pair(1, "AC1009");
    dxf.pair(9, "$MEASUREMENT"), dxf.pair(70, 1);   // millimetres; R12 readers without the key ignore it
    dxf.pair(9, "$EXTMIN"), dxf.point_at(box.low), dxf.real(30, 0);
    dxf.pair(9, "$EXTMAX"), dxf.point_at(box.high), dxf.real(30, 0);
    dxf.pair(0, "ENDSEC");
    dxf.pair(0, "SECTION"), dxf.pair(2, "TABLES");
    dxf.pair(0, "TABLE"), dxf.pair(2, "LTYPE"), dxf.pair(70, 1);
    dxf.pair(0, "LTYPE"), dxf.pair(2, "CONTINUOUS"), dxf.pair(70, 0), dxf.pair(3, "Solid line"), dxf.pair(72, 65), dxf.pair(73, 0), dxf.real(40, 0);
    dxf.pair(0, "ENDTAB");
    dxf.pair(0, "TABLE"), dxf.pair(2, "LAYER"), dxf.pair(70, static_cast<int>(layers.size()));
    for (const auto& [name, colour] : layers)
        dxf.pair(0, "LAYER"), dxf.pair(2, name), dxf.pair(70, 0), dxf.pair(62, colour), dxf.pair(6, "CONTINUOUS");
    dxf.pair(0, "ENDTAB"), dxf.pair(0, "ENDSEC");
}

}  // namespace

std::string pattern_dxf(const Pattern& pattern) {
    DxfText dxf(4);
    write_tables(dxf, {Vector2d(0, 0), Vector2d(pattern.nest.length, pattern.nest.width)});
    dxf.pair(0, "SECTION"), dxf.pair(2, "ENTITIES");
    for (std::size_t i = 0; i < pattern.pieces.size(); ++i) {
        const PatternPiece& piece = pattern.pieces[i];
        const Placement& place = pattern.nest.placement[i];
        const auto laid = [&](const Line& line) {
            Line moved;
            for (const Vector2d& p : line) moved.push_back(place(p));
            return moved;
        };
        dxf.polyline("CUT", laid(piece.cut), true);
        dxf.polyline("SEW", laid(piece.sew), true);
        for (const NotchMark& notch : piece.notches)
            for (const Line& stroke : notch.strokes)
                for (std::size_t k = 0; k + 1 < stroke.size(); ++k) dxf.line("NOTCH", place(stroke[k]), place(stroke[k + 1]));
        dxf.line("GRAIN", place(piece.grain[0]), place(piece.grain[1]));
        for (const Line& head : grain_heads(piece)) dxf.polyline("GRAIN", laid(head), false);
        for (const TextMark& t : piece.texts) {
            if (pattern.params.text == Lettering::characters) {
                dxf.text("LABEL", place(t.at), t.height, t.angle + place.turn(), t.text, true);
            } else {
                for (const Line& stroke : text_strokes(t)) dxf.polyline("LABEL", laid(stroke), false);
            }
        }
    }
    dxf.pair(0, "ENDSEC");
    return dxf.finish();
}

}  // namespace formwork
