#include "formwork/panels/pattern.hpp"

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

}  // namespace

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
    pattern.order = sewing_order(set, s, info.up);
    return pattern;
}

}  // namespace formwork
