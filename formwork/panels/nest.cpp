#include "formwork/panels/nest.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/panels/polygon.hpp"

namespace formwork {
namespace {

constexpr int cells_across = 500;        // of the roll: fine enough for pieces of a few centimetres
constexpr double smallest_cell = 0.5;    // mm
constexpr int random_orders = 8;         // beside the three sorted ones

using Column = std::vector<std::uint64_t>;   // bits across the roll

/// One piece in one orientation: which cells it claims, its gap included.
struct Mask {
    int quarter_turns = 0;
    Vector2d low{0, 0}, size{0, 0};   // of the turned outline's box, mm
    std::vector<Column> columns;
    int height = 0;                   // cells across the roll
};

Vector2d turned(const Vector2d& p, int quarter_turns) {
    switch (quarter_turns % 4) {
        case 1: return {-p.y(), p.x()};
        case 2: return -p;
        case 3: return {p.y(), -p.x()};
        default: return p;
    }
}

/// A cell belongs to a piece when its centre is nearer than half the gap plus half the cell's diagonal. Two
/// points of different pieces nearer than the gap have their midpoint in a cell that both would claim.
Mask make_mask(const PatternPiece& piece, int quarter_turns, double gap, double cell) {
    Mask mask;
    mask.quarter_turns = quarter_turns;
    Polygon outline;
    for (const Vector2d& p : piece.cut) outline.push_back(turned(p, quarter_turns));
    const Box box = bounding_box(outline);
    mask.low = box.low;
    mask.size = box.size();
    const double reach = gap / 2 + cell * std::sqrt(0.5);
    const Polygon grown = inflated(outline, reach);
    const Vector2d origin = box.low - Vector2d(reach, reach);
    const int n_columns = static_cast<int>(std::ceil((mask.size.x() + 2 * reach) / cell)) + 1;
    mask.height = static_cast<int>(std::ceil((mask.size.y() + 2 * reach) / cell)) + 1;
    for (int c = 0; c < n_columns; ++c) {
        Column column((mask.height + 63) / 64, 0);
        const double x = origin.x() + (c + 0.5) * cell;
        std::vector<double> crossings;
        for (std::size_t i = 0; i < grown.size(); ++i) {
            const Vector2d &a = grown[i], &b = grown[(i + 1) % grown.size()];
            if ((a.x() > x) != (b.x() > x)) crossings.push_back(a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x()));
        }
        std::sort(crossings.begin(), crossings.end());
        for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
            const int from = std::max(0, static_cast<int>(std::floor((crossings[k] - origin.y()) / cell)));
            const int to = std::min(mask.height - 1, static_cast<int>(std::ceil((crossings[k + 1] - origin.y()) / cell)));
            for (int r = from; r <= to; ++r) column[r / 64] |= std::uint64_t{1} << (r % 64);
        }
        mask.columns.push_back(std::move(column));
    }
    return mask;
}

class Roll {
public:
    Roll(double width, double gap, double cell) : width_(width), cell_(cell) {
        const double reach = gap / 2 + cell * std::sqrt(0.5);
        words_ = static_cast<std::size_t>(std::ceil((width + 2 * reach) / cell)) / 64 + 3;
    }

    bool is_free(const Mask& mask, int x, int y) const {
        const int word = y / 64, shift = y % 64;
        for (std::size_t c = 0; c < mask.columns.size() && x + c < used_.size(); ++c) {
            const Column &here = used_[x + c], &piece = mask.columns[c];
            for (std::size_t w = 0; w < piece.size(); ++w) {
                if (here[word + w] & (piece[w] << shift)) return false;
                if (shift && (here[word + w + 1] & (piece[w] >> (64 - shift)))) return false;
            }
        }
        return true;
    }

    void occupy(const Mask& mask, int x, int y) {
        const int word = y / 64, shift = y % 64;
        if (used_.size() < x + mask.columns.size()) used_.resize(x + mask.columns.size(), Column(words_, 0));
        for (std::size_t c = 0; c < mask.columns.size(); ++c)
            for (std::size_t w = 0; w < mask.columns[c].size(); ++w) {
                used_[x + c][word + w] |= mask.columns[c][w] << shift;
                if (shift) used_[x + c][word + w + 1] |= mask.columns[c][w] >> (64 - shift);
            }
    }

    int rows_for(const Mask& mask) const { return static_cast<int>((width_ - mask.size.y()) / cell_ + 1e-9); }
    int columns() const { return static_cast<int>(used_.size()); }

private:
    double width_, cell_;
    std::size_t words_;
    std::vector<Column> used_;
};

Nest place_in_order(const std::vector<int>& order, const std::vector<std::vector<Mask>>& masks, double width, double gap, double cell) {
    Roll roll(width, gap, cell);
    Nest nest;
    nest.placement.resize(order.size());
    for (int i : order) {
        double best_end = std::numeric_limits<double>::infinity();
        int best_x = 0, best_y = 0;
        const Mask* best = nullptr;
        for (const Mask& mask : masks[i]) {
            bool placed = false;
            for (int x = 0; x <= roll.columns() && !placed; ++x) {
                if (x * cell + mask.size.x() >= best_end - 1e-9) break;   // another orientation ends earlier
                for (int y = 0; y <= roll.rows_for(mask) && !placed; ++y)
                    if (roll.is_free(mask, x, y)) {
                        best_end = x * cell + mask.size.x();
                        best_x = x, best_y = y, best = &mask;
                        placed = true;
                    }
            }
        }
        roll.occupy(*best, best_x, best_y);
        nest.placement[i] = {best->quarter_turns, Vector2d(best_x * cell, best_y * cell) - best->low};
        nest.length = std::max(nest.length, best_end);
        nest.width = std::max(nest.width, best_y * cell + best->size.y());
    }
    return nest;
}

void check_overlaps(const std::vector<PatternPiece>& pieces, const Nest& nest) {
    std::vector<Polygon> laid(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i)
        for (const Vector2d& p : pieces[i].cut) laid[i].push_back(nest.placement[i](p));
    constexpr double rounding = 1e-3;   // mm²
    for (std::size_t i = 0; i < laid.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Box a = bounding_box(laid[i]), b = bounding_box(laid[j]);
            if ((a.high.array() < b.low.array()).any() || (b.high.array() < a.low.array()).any()) continue;
            if (overlap_area(laid[i], laid[j]) > rounding)
                throw arcsim::NumericalError("panels: nesting laid " + pieces[i].name + " over " + pieces[j].name + ".");
        }
}

}  // namespace

Vector2d Placement::operator()(const Vector2d& p) const { return turned(p, quarter_turns) + offset; }

Nest nest_pieces(const std::vector<PatternPiece>& pieces, const PanelParams& params) {
    const double cell = std::max(smallest_cell, params.roll_width_mm / cells_across);
    std::vector<std::vector<Mask>> masks(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Vector2d size = bounding_box(pieces[i].cut).size();
        for (int turns : {0, 2, 1, 3}) {
            if (turns % 2 && !params.quarter_turns) continue;
            if ((turns % 2 ? size.x() : size.y()) > params.roll_width_mm) continue;
            masks[i].push_back(make_mask(pieces[i], turns, params.nest_gap_mm, cell));
        }
        if (masks[i].empty())
            throw arcsim::InputError("panels: panel " + std::to_string(i + 1) + " is " + arcsim::format_short(size.y(), 5) +
                                     " mm wide across the warp, the roll " + arcsim::format_short(params.roll_width_mm, 5) +
                                     " mm. Use a wider roll (/formwork/panels/roll_width_mm), allow quarter_turns, or cut into more panels "
                                     "(/formwork/segment/max_panels).");
    }

    std::vector<int> order(pieces.size());
    std::iota(order.begin(), order.end(), 0);
    Nest best;
    const auto attempt = [&] {
        const Nest nest = place_in_order(order, masks, params.roll_width_mm, params.nest_gap_mm, cell);
        const bool shorter = nest.length < best.length - 1e-9 || (nest.length < best.length + 1e-9 && nest.width < best.width);
        if (best.placement.empty() || shorter) best = nest;
    };
    const auto by = [&](auto measure) {
        std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return measure(pieces[a]) > measure(pieces[b]); });
        attempt();
    };
    by([](const PatternPiece& p) { return bounding_box(p.cut).size().x(); });
    by([](const PatternPiece& p) { return bounding_box(p.cut).size().y(); });
    by([](const PatternPiece& p) { return p.cut_area; });
    std::mt19937 random(1);   // disturbed from the order by area
    for (int trial = 0; trial < random_orders && pieces.size() > 2; ++trial) {
        for (std::size_t swap = 0; swap < pieces.size() / 3 + 1; ++swap)
            std::swap(order[random() % order.size()], order[random() % order.size()]);
        attempt();
    }

    double area = 0;
    for (const PatternPiece& piece : pieces) area += piece.cut_area;
    best.utilisation = area / (params.roll_width_mm * best.length);
    check_overlaps(pieces, best);
    return best;
}

}  // namespace formwork
