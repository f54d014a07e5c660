#include <algorithm>
#include <cmath>
#include <string>

#include "arcsim/base/text.hpp"
#include "formwork/panels/marks.hpp"
#include "formwork/panels/polygon.hpp"

namespace formwork {
namespace {

constexpr double mm = 1000;             // per metre
constexpr double letter_width = 0.85;   // of the capital height: mean advance of Helvetica, rounded up
constexpr double smallest_text = 1.8;   // mm; smaller lettering cannot be read

double text_width(const std::string& text, double height) { return letter_width * height * static_cast<double>(text.size()); }

double upright(double angle) {   // never upside down
    while (angle > M_PI / 2) angle -= M_PI;
    while (angle <= -M_PI / 2) angle += M_PI;
    return angle;
}

std::string millimetres(double metres) { return arcsim::format_short(std::round(mm * metres * 10) / 10, 6) + " mm"; }

/// "S03 > P05 242 mm" along the seam, inside the sew line; shortened when the seam is short.
void label_seam(const PanelSet& set, int seam_index, int side, PatternPiece& piece) {
    const PanelSeam& seam = set.seams[seam_index];
    Line chain;
    for (const Vector2d& u : flat_chain(set, seam.side[side])) chain.push_back(mm * u);
    const double length = mm * seam.side[side].length;
    const std::string name = seam_name(set, seam_index);
    const std::string to = seam.is_rim() ? name + " hem" : name + " > " + panel_name(seam.side[1 - side].panel);
    for (const std::string& text : {to + "  " + millimetres(seam.side[side].length), to, name})
        for (double height : {3.0, 2.4, smallest_text}) {
            if (text_width(text, height) > 0.8 * length) continue;
            const ChainPoint p = chain_point(chain, 0.5);
            const Vector2d in = (side == 0 ? -1.0 : 1.0) * Vector2d(p.tangent.y(), -p.tangent.x());
            TextMark mark{{0, 0}, height, upright(std::atan2(p.tangent.y(), p.tangent.x())), text, seam_index};
            const Vector2d up(-std::sin(mark.angle), std::cos(mark.angle));
            // Capitals stand on the base line: it keeps 2 mm from the sew line on whichever side that is.
            mark.at = p.at + (up.dot(in) > 0 ? 2.0 : 2.0 + height) * in;
            const double half = text_width(text, height) / 2;
            const Vector2d along(std::cos(mark.angle), std::sin(mark.angle));
            bool inside = true;
            for (double s : {-1.0, 0.0, 1.0})
                for (double h : {0.0, height}) inside = inside && contains(piece.sew, mark.at + s * half * along + h * up);
            if (!inside && text != name) continue;
            piece.texts.push_back(std::move(mark));
            return;
        }
}

}  // namespace

void add_labels(const PanelSet& set, const PatternInfo& info, PatternPiece& piece) {
    for (std::size_t i = 0; i < set.seams.size(); ++i)
        for (int side : {0, 1})
            if (set.seams[i].side[side].panel == piece.panel) label_seam(set, static_cast<int>(i), side, piece);

    // Title block around the widest room, the arrow below it.
    const std::string of = " of " + std::to_string(set.panels.size());
    const std::vector<std::pair<std::string, double>> lines{
        {piece.name + of, 1.6},
        {info.name + "  " + info.date, 1},
        {"cut " + std::to_string(set.params.cut_count) + "  outside face up", 1}};
    const Room room = widest_room(piece.sew);
    double widest = 0, total = 0;
    constexpr double leading = 1.7, arrow_gap = 2.2;   // in text heights
    for (const auto& [text, scale] : lines) {
        widest = std::max(widest, text_width(text, scale));
        total += leading * scale;
    }
    total += arrow_gap;
    const double half_diagonal = std::hypot(widest / 2, total / 2);
    const double height = std::clamp(0.8 * room.radius / half_diagonal, smallest_text, 5.0);
    double y = room.at.y() + total / 2 * height;
    for (const auto& [text, scale] : lines) {
        y -= leading * scale * height;
        piece.texts.push_back({{room.at.x(), y}, scale * height, 0, text, -1});
    }

    const Vector2d middle(room.at.x(), y - 0.85 * arrow_gap * height);
    const double right = ray_to_outline(piece.sew, middle, Vector2d::UnitX()).value_or(room.radius);
    const double left = ray_to_outline(piece.sew, middle, -Vector2d::UnitX()).value_or(room.radius);
    constexpr double share = 0.8, longest = 200;   // of the way to the sew line; mm on each side
    piece.grain = {middle - Vector2d(std::min(share * left, longest), 0), middle + Vector2d(std::min(share * right, longest), 0)};
    piece.texts.push_back({middle + Vector2d(0, 0.4 * height), 0.8 * height, 0, "warp", -1});
}

}  // namespace formwork
