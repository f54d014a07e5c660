#include "formwork/panels/pattern.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <ctime>

#include "formwork/panels/marks.hpp"
#include "formwork/panels/nest.hpp"
#include "formwork/panels/sewing_order.hpp"

namespace formwork {
namespace {

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[16];
    std::strftime(text, sizeof text, "%Y-%m-%d", &utc);
    return text;
}

/// Copies of a bag share the width of the roll.
double roll_length_for_all(const Pattern& pattern) {
    constexpr std::size_t most_pieces = 120;   // nested together; more are nested as groups of whole bags
    const std::size_t count = static_cast<std::size_t>(pattern.params.cut_count), n = pattern.pieces.size();
    const std::size_t together = std::min(count, std::max<std::size_t>(1, most_pieces / n));
    const auto length_of = [&](std::size_t bags) {
        if (bags <= 1) return static_cast<double>(bags) * pattern.nest.length;
        std::vector<PatternPiece> copies;
        for (std::size_t k = 0; k < bags; ++k) copies.insert(copies.end(), pattern.pieces.begin(), pattern.pieces.end());
        return std::min(static_cast<double>(bags) * pattern.nest.length, nest_pieces(copies, pattern.params).length);
    };
    return static_cast<double>(count / together) * length_of(together) + length_of(count % together);
}

}  // namespace

std::array<Line, 2> grain_heads(const PatternPiece& piece) {
    constexpr double length = 4, half_width = 1.5;   // mm
    const Vector2d d = (piece.grain[1] - piece.grain[0]).normalized(), side(-d.y(), d.x());
    const auto head = [&](const Vector2d& tip, const Vector2d& ahead) {
        return Line{tip - length * ahead + half_width * side, tip, tip - length * ahead - half_width * side};
    };
    return {head(piece.grain[0], -d), head(piece.grain[1], d)};
}

PatternPiece turned_piece(PatternPiece piece, double angle) {
    const Eigen::Rotation2Dd turn(angle);
    const auto move = [&](Line& line) {
        for (Vector2d& p : line) p = turn * p;
    };
    move(piece.sew), move(piece.cut);
    for (Line& fold : piece.folds) move(fold);
    for (NotchMark& notch : piece.notches) {
        notch.sew = turn * notch.sew, notch.cut = turn * notch.cut;
        for (NotchMark::Foot& foot : notch.feet) foot.at = turn * foot.at;
        for (Line& stroke : notch.strokes) move(stroke);
    }
    for (Vector2d& end : piece.grain) end = turn * end;
    for (TextMark& text : piece.texts) text.at = turn * text.at, text.angle += angle;
    return piece;
}

Pattern make_pattern(const PanelSet& set, const Segmentation& s, const PatternInfo& info) {
    check_allowances(set);
    Pattern pattern;
    pattern.info = info;
    if (pattern.info.date.empty()) pattern.info.date = today();
    pattern.params = set.params;
    for (std::size_t p = 0; p < set.panels.size(); ++p) {
        PatternPiece piece = outline_piece(set, static_cast<int>(p));
        add_notches(set, piece);
        add_labels(set, pattern.info, piece);
        pattern.pieces.push_back(std::move(piece));
    }
    pattern.nest = nest_pieces(pattern.pieces, set.params);
    pattern.roll_length = roll_length_for_all(pattern);
    pattern.order = sewing_order(set, s, info.up);
    return pattern;
}

}  // namespace formwork
