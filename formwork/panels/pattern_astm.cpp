#include <algorithm>
#include <cctype>
#include <cmath>

#include "arcsim/base/error.hpp"
#include "formwork/panels/dxf_text.hpp"
#include "formwork/panels/pattern_files.hpp"
#include "formwork/panels/polygon.hpp"

namespace formwork {
namespace {

// AAMA layer numbers; 84, 85, 87 are the exact copies of 1, 8 and 14 that ASTM asks for.
constexpr const char *boundary = "1", *turn_points = "2", *curve_points = "3", *notches = "4", *grain = "7", *internal = "8",
                     *sew_line = "14", *notes = "15", *boundary_copy = "84", *internal_copy = "85", *sew_copy = "87", *tee_notches = "80";
constexpr double turn_angle_cosine = 0.8660254;   // 30°: a corner
constexpr std::size_t longest_name = 20;

/// A block name as the strict readers want it: A-Z, 0-9 and _, at most 20.
std::string block_name(const std::string& bag, const std::string& piece) {
    std::string name;
    for (char c : ascii(bag)) name += std::isalnum(static_cast<unsigned char>(c)) ? static_cast<char>(std::toupper(c)) : '_';
    return name.substr(0, longest_name - piece.size() - 1) + "_" + piece;
}

void outline_points(DxfText& dxf, const Line& outline) {
    const std::size_t n = outline.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vector2d in = (outline[i] - outline[(i + n - 1) % n]).normalized(), out = (outline[(i + 1) % n] - outline[i]).normalized();
        dxf.point(in.dot(out) < turn_angle_cosine ? turn_points : curve_points, outline[i]);
    }
}

void check(const PatternPiece& piece) {
    if (piece.cut.size() < 3 || piece.sew.size() < 3)
        throw arcsim::InputError("panels-astm.dxf: " + piece.name + " has fewer than three points.");
    if (!((piece.grain[1] - piece.grain[0]).norm() > 0))
        throw arcsim::InputError("panels-astm.dxf: " + piece.name + " has no room for a grain line.");
}

void write_block(DxfText& dxf, const Pattern& pattern, const PatternPiece& piece, const std::string& name) {
    dxf.pair(0, "BLOCK"), dxf.pair(8, "1"), dxf.pair(2, name), dxf.pair(70, 0), dxf.point_at({0, 0}), dxf.pair(3, name);
    double y = bounding_box(piece.cut).low.y() - 10;
    const auto system = [&](const std::string& text) { dxf.text(boundary, {bounding_box(piece.cut).low.x(), y -= 5}, 2.5, 0, text, false); };
    system("Piece Name: " + piece.name);
    system("Size: 1");
    system("Quantity: " + std::to_string(pattern.params.cut_count));
    system("Material: FABRIC");
    dxf.polyline(boundary, piece.cut, true);
    outline_points(dxf, piece.cut);
    for (const NotchMark& notch : piece.notches)
        for (const NotchMark::Foot& foot : notch.feet) dxf.point(foot.shape == NotchShape::tee ? tee_notches : notches, foot.at);
    dxf.line(grain, piece.grain[0], piece.grain[1]);
    for (const Line& fold : piece.folds) dxf.polyline(internal, fold, false);
    dxf.polyline(sew_line, piece.sew, true);
    outline_points(dxf, piece.sew);
    for (const TextMark& t : piece.texts) dxf.text(notes, t.at, t.height, t.angle, t.text, false);
    dxf.polyline(boundary_copy, piece.cut, true);
    for (const Line& fold : piece.folds) dxf.polyline(internal_copy, fold, false);
    dxf.polyline(sew_copy, piece.sew, true);
    dxf.pair(0, "ENDBLK"), dxf.pair(8, "1");
}

}  // namespace

std::string pattern_astm(const Pattern& pattern) {
    for (const PatternPiece& piece : pattern.pieces) check(piece);
    DxfText dxf(2);   // the standard's precision for millimetres
    dxf.pair(0, "SECTION"), dxf.pair(2, "HEADER"), dxf.pair(9, "$ACADVER"), dxf.pair(1, "AC1009"), dxf.pair(0, "ENDSEC");
    dxf.pair(0, "SECTION"), dxf.pair(2, "BLOCKS");
    for (const PatternPiece& piece : pattern.pieces) write_block(dxf, pattern, piece, block_name(pattern.info.name, piece.name));
    dxf.pair(0, "ENDSEC");
    dxf.pair(0, "SECTION"), dxf.pair(2, "ENTITIES");
    const std::string &date = pattern.info.date, day = date.size() == 10 ? date.substr(8, 2) + "-" + date.substr(5, 2) + "-" + date.substr(0, 4) : date;
    double y = -45;   // below the first piece and its own texts
    for (const std::string& text :
         {std::string("ASTM/D13Proposal 1 Version: D 6673-04"), "Style Name: " + ascii(pattern.info.name).substr(0, longest_name),
          "Creation Date: " + day, std::string("Creation Time: 00:00"), std::string("Author: formwork"), std::string("Sample Size: 1"),
          std::string("Grade Rule Table: NONE"), std::string("Units: METRIC")})
        dxf.text(boundary, {0, y -= 5}, 2.5, 0, text, false);
    for (std::size_t i = 0; i < pattern.pieces.size(); ++i) {
        const Placement& place = pattern.nest.placement[i];
        dxf.pair(0, "INSERT"), dxf.pair(8, "1"), dxf.pair(2, block_name(pattern.info.name, pattern.pieces[i].name)), dxf.point_at(place.offset);
        if (place.quarter_turns) dxf.real(50, 90 * place.quarter_turns);
    }
    dxf.pair(0, "ENDSEC");
    return dxf.finish();
}

}  // namespace formwork
