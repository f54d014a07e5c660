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
constexpr double clearance = 1;         // mm around lettering

double text_width(const std::string& text, double height) { return letter_width * height * static_cast<double>(text.size()); }

double upright(double angle) {   // never upside down
    while (angle > M_PI / 2) angle -= M_PI;
    while (angle <= -M_PI / 2) angle += M_PI;
    return angle;
}

std::string millimetres(double metres) { return arcsim::format_short(std::round(mm * metres * 10) / 10, 6) + " mm"; }

/// Lettering of one piece: nothing is written over anything else or across a line.
class Sheet {
public:
    explicit Sheet(const PatternPiece& piece) : piece_(piece) {}

    bool fits_inside(const Polygon& box) const { return is_free(box) && overlap_area(box, piece_.sew) > full * signed_area(box); }
    bool fits_in_allowance(const Polygon& box) const {
        return is_free(box) && overlap_area(box, piece_.sew) <= 0 && overlap_area(box, piece_.cut) > full * signed_area(box) &&
               std::none_of(piece_.notches.begin(), piece_.notches.end(), [&](const NotchMark& n) {
                   return std::any_of(n.strokes.begin(), n.strokes.end(), [&](const Line& line) {
                       return std::any_of(line.begin(), line.end(), [&](const Vector2d& p) { return contains(box, p); });
                   });
               });
    }
    void occupy(Polygon box) { taken_.push_back(std::move(box)); }

private:
    static constexpr double full = 1 - 1e-6;
    bool is_free(const Polygon& box) const {
        return std::none_of(taken_.begin(), taken_.end(), [&](const Polygon& other) { return overlap_area(box, other) > 0; });
    }
    const PatternPiece& piece_;
    std::vector<Polygon> taken_;
};

/// One side of a seam on the piece, and what is written along it.
struct SeamLabel {
    int seam = 0;
    Line chain;
    double inward = 1;       // the piece lies left (+1) or right (-1) of the chain
    std::string name, text;  // "S03", "S03 > P05  242 mm"
};

std::vector<SeamLabel> seam_labels(const PanelSet& set, int panel) {
    std::vector<SeamLabel> labels;
    for (std::size_t i = 0; i < set.seams.size(); ++i)
        for (int side : {0, 1}) {
            const PanelSeam& seam = set.seams[i];
            if (seam.side[side].panel != panel) continue;
            SeamLabel label{static_cast<int>(i), {}, side == 0 ? 1.0 : -1.0, seam_name(set, static_cast<int>(i)), {}};
            for (const Vector2d& u : flat_chain(set, seam.side[side])) label.chain.push_back(mm * u);
            label.text = label.name + (seam.is_rim() ? " hem" : " > " + panel_name(seam.side[1 - side].panel)) + "  " +
                         millimetres(seam.side[side].length);
            labels.push_back(std::move(label));
        }
    return labels;
}

/// Writes `text` along the seam, inside the sew line or else in the allowance; false when there is no room.
bool write_along(const SeamLabel& label, const std::string& text, Sheet& sheet, PatternPiece& piece) {
    constexpr double gap = 2;   // mm between the sew line and the lettering
    for (double direction : {label.inward, -label.inward})
        for (double height : {3.0, 2.4, smallest_text})
            for (double share : {0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9}) {
                const ChainPoint p = chain_point(label.chain, share);
                const Vector2d away = direction * Vector2d(-p.tangent.y(), p.tangent.x());
                TextMark mark{{0, 0}, height, upright(std::atan2(p.tangent.y(), p.tangent.x())), text, label.seam};
                const Vector2d up(-std::sin(mark.angle), std::cos(mark.angle));
                // Capitals stand on the base line: it keeps its gap from the sew line on whichever side that is.
                mark.at = p.at + (up.dot(away) > 0 ? gap : gap + height) * away;
                const Polygon box = text_box(mark);
                if (!(direction == label.inward ? sheet.fits_inside(box) : sheet.fits_in_allowance(box))) continue;
                sheet.occupy(box);
                piece.texts.push_back(std::move(mark));
                return true;
            }
    return false;
}

/// Title and arrow around the widest room of the piece, as large as it allows.
void write_title(const std::vector<std::pair<std::string, double>>& lines, Sheet& sheet, PatternPiece& piece) {
    const Room room = widest_room(piece.sew);
    constexpr double leading = 1.7, arrow_gap = 2.2;   // in text heights
    double widest = 0, total = arrow_gap;
    for (const auto& [text, scale] : lines) {
        widest = std::max(widest, text_width(text, scale));
        total += leading * scale;
    }
    const auto block = [&](double height) {
        const Vector2d half(widest / 2 * height + clearance, total / 2 * height + clearance);
        return Polygon{room.at - half, room.at + Vector2d(half.x(), -half.y()), room.at + half, room.at + Vector2d(-half.x(), half.y())};
    };
    double height = 5;
    constexpr double tiniest = 0.5;   // mm: better small than written over the outline of a tiny piece
    while (height > tiniest && !sheet.fits_inside(block(height))) height *= 0.9;
    sheet.occupy(block(height));
    double y = room.at.y() + total / 2 * height;
    for (const auto& [text, scale] : lines) {
        y -= leading * scale * height;
        piece.texts.push_back({{room.at.x(), y}, scale * height, 0, text, -1});
    }
    Vector2d middle(room.at.x(), y - 0.85 * arrow_gap * height);
    if (!contains(piece.sew, middle)) middle = room.at;   // a piece smaller than its title
    const double right = ray_to_outline(piece.sew, middle, Vector2d::UnitX()).value_or(room.radius);
    const double left = ray_to_outline(piece.sew, middle, -Vector2d::UnitX()).value_or(room.radius);
    constexpr double share = 0.8, longest = 200;   // of the way to the sew line; mm on each side
    piece.grain = {middle - Vector2d(std::min(share * left, longest), 0), middle + Vector2d(std::min(share * right, longest), 0)};
    const Vector2d thick(0, 2);
    sheet.occupy({piece.grain[0] - thick, piece.grain[1] - thick, piece.grain[1] + thick, piece.grain[0] + thick});
    piece.texts.push_back({middle + Vector2d(0, 0.4 * height), 0.8 * height, 0, "warp", -1});
}

}  // namespace

Line text_box(const TextMark& t) {
    const Vector2d along(std::cos(t.angle), std::sin(t.angle)), up(-along.y(), along.x());
    const double half = text_width(t.text, t.height) / 2 + clearance, below = 0.25 * t.height + clearance, above = t.height + clearance;
    return {t.at - half * along - below * up, t.at + half * along - below * up, t.at + half * along + above * up, t.at - half * along + above * up};
}

void add_labels(const PanelSet& set, const PatternInfo& info, PatternPiece& piece) {
    std::vector<SeamLabel> labels = seam_labels(set, piece.panel);
    std::vector<std::pair<std::string, double>> lines{
        {piece.name + " of " + std::to_string(set.panels.size()), 1.6},
        {info.name + "  " + info.date, 1},
        {"cut " + std::to_string(set.params.cut_count) + "  outside face up", 1}};
    // What finds no room at its seam is listed in the title, which then needs more room itself.
    for (std::vector<char> listed(labels.size(), 0);;) {
        Sheet sheet(piece);
        piece.texts.clear();
        write_title(lines, sheet, piece);
        bool again = false;
        for (std::size_t k = 0; k < labels.size(); ++k) {
            if (listed[k]) {
                write_along(labels[k], labels[k].name, sheet, piece);
            } else if (!write_along(labels[k], labels[k].text, sheet, piece)) {
                lines.emplace_back(labels[k].text, 0.8);
                listed[k] = again = true;
            }
        }
        if (!again) return;
    }
}

}  // namespace formwork
