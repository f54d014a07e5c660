#include <algorithm>

#include "formwork/panels/marks.hpp"
#include "formwork/panels/polygon.hpp"

namespace formwork {
namespace {

constexpr double mm = 1000;            // per metre
constexpr double bar = 2;              // mm, half the bar of a T and half the mouth of a V

/// One stroke at `edge` (on the cut line), `depth` towards the sew line.
std::vector<Line> stroke(NotchShape shape, const Vector2d& edge, const Vector2d& inward, const Vector2d& along, double depth) {
    const Vector2d tip = edge + depth * inward;
    if (shape == NotchShape::vee) return {{edge - bar * along, tip, edge + bar * along}};
    if (shape == NotchShape::tee) return {{edge, tip}, {tip - bar * along, tip + bar * along}};
    return {{edge, tip}};
}

/// Where a notch of the sew line's point `foot` meets the cut line: straight across the allowance, or at the
/// nearest point where that would run past a concave corner.
Vector2d on_cut_line(const PatternPiece& piece, const Vector2d& foot, const Vector2d& out, double allowance) {
    constexpr double detour = 1.5;   // of the allowance: a mitre is longer than the allowance, another edge is farther
    const auto reach = ray_to_outline(piece.cut, foot, out);
    if (reach && *reach <= detour * allowance + 0.5) return foot + *reach * out;
    return nearest_on_outline(piece.cut, foot);
}

}  // namespace

void add_notches(const PanelSet& set, PatternPiece& piece) {
    for (std::size_t i = 0; i < set.seams.size(); ++i) {
        const PanelSeam& seam = set.seams[i];
        const double allowance = allowance_mm(set, static_cast<int>(i));
        for (int side : {0, 1}) {
            if (seam.is_rim() || seam.side[side].panel != piece.panel) continue;
            Line chain;
            for (const Vector2d& u : flat_chain(set, seam.side[side])) chain.push_back(mm * u);
            for (std::size_t k = 0; k < seam.notch.size(); ++k) {
                const ChainPoint p = chain_point(chain, seam.notch[k]);
                // The piece lies left of the chain on side 0 and right of it on side 1.
                const Vector2d out = (side == 0 ? 1.0 : -1.0) * Vector2d(p.tangent.y(), -p.tangent.x());
                NotchMark mark;
                mark.seam = static_cast<int>(i);
                mark.sew = p.at;
                mark.cut = on_cut_line(piece, p.at, out, allowance);
                const NotchStyle style = k == 0 ? notch_style(seam.style) : NotchStyle{};
                for (std::size_t s = 0; s < style.strokes.size(); ++s) {
                    const Vector2d foot = p.at + stroke_offset_mm(style, s) * p.tangent;
                    const Vector2d edge = on_cut_line(piece, foot, out, allowance);
                    const double room = (edge - foot).norm();
                    // A slit must not reach the sew line; without allowance the mark is drawn inside the piece.
                    const bool has_room = room > 1;
                    const Vector2d inward = has_room ? Vector2d((foot - edge) / room) : Vector2d(-out);
                    const double depth = has_room ? std::min(set.params.notch_length_mm, 0.6 * room) : set.params.notch_length_mm;
                    mark.feet.push_back({style.strokes[s], edge});
                    for (Line& line : stroke(style.strokes[s], has_room ? edge : foot, inward, Vector2d(inward.y(), -inward.x()), depth))
                        mark.strokes.push_back(std::move(line));
                }
                mark.strokes.push_back({p.at - 1.5 * out, p.at + std::min(1.5, 0.2 * (mark.cut - p.at).norm()) * out});   // tick on the sew line
                piece.notches.push_back(std::move(mark));
            }
        }
    }
}

}  // namespace formwork
