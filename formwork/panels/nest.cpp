#include "formwork/panels/nest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/panels/nest_raster.hpp"
#include "formwork/panels/polygon.hpp"

namespace formwork {
namespace {

constexpr int cells_across = 500;      // of the roll: fine enough for pieces of a few centimetres
constexpr double smallest_cell = 1;    // mm
constexpr int random_orders = 8;       // beside the three sorted ones

Nest place_in_order(const std::vector<int>& order, const std::vector<std::vector<NestMask>>& masks, const NestGrid& grid) {
    NestRoll roll(grid);
    Nest nest;
    nest.placement.resize(order.size());
    for (int i : order) {
        double best_end = std::numeric_limits<double>::infinity();
        int best_x = 0, best_y = 0;
        const NestMask* best = nullptr;
        for (const NestMask& mask : masks[i])
            for (int x = 0; x <= roll.columns(); ++x) {
                if (x * grid.cell + mask.size.x() >= best_end - 1e-9) break;   // another orientation ends earlier
                const int y = roll.lowest_free(mask, x);
                if (y < 0) continue;
                best_end = x * grid.cell + mask.size.x();
                best_x = x, best_y = y, best = &mask;
                break;
            }
        roll.occupy(*best, best_x, best_y);
        nest.placement[i] = {best->quarter_turns, Vector2d(best_x, best_y) * grid.cell - best->low};
        nest.length = std::max(nest.length, best_end);
        nest.width = std::max(nest.width, best_y * grid.cell + best->size.y());
    }
    return nest;
}

/// The masks of every piece that lie along the roll, or across it; all of them where a piece fits only the other way.
std::vector<std::vector<NestMask>> turned_alike(const std::vector<std::vector<NestMask>>& masks, int parity) {
    std::vector<std::vector<NestMask>> chosen(masks.size());
    for (std::size_t i = 0; i < masks.size(); ++i) {
        for (const NestMask& mask : masks[i])
            if (mask.quarter_turns % 2 == parity) chosen[i].push_back(mask);
        if (chosen[i].empty()) chosen[i] = masks[i];
    }
    return chosen;
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

Vector2d Placement::operator()(const Vector2d& p) const { return quarter_turned(p, quarter_turns) + offset; }

Nest nest_pieces(const std::vector<PatternPiece>& pieces, const PanelParams& params) {
    const NestGrid grid{params.roll_width_mm, params.nest_gap_mm, std::max(smallest_cell, params.roll_width_mm / cells_across)};
    std::vector<std::vector<NestMask>> masks(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Vector2d size = bounding_box(pieces[i].cut).size();
        for (int turns : {0, 2, 1, 3}) {
            if (turns % 2 && !params.quarter_turns) continue;
            if ((turns % 2 ? size.x() : size.y()) > params.roll_width_mm) continue;
            masks[i].push_back(make_mask(pieces[i], turns, grid));
        }
        if (masks[i].empty())
            throw arcsim::InputError("panels: panel " + std::to_string(i + 1) + " is " + arcsim::format_short(size.y(), 5) +
                                     " mm wide across the warp, the roll " + arcsim::format_short(params.roll_width_mm, 5) +
                                     " mm. Use a wider roll (/formwork/panels/roll_width_mm), allow quarter_turns, or cut into more panels "
                                     "(/formwork/segment/max_panels).");
    }

    std::vector<int> order(pieces.size());
    std::iota(order.begin(), order.end(), 0);
    std::vector<std::vector<std::vector<NestMask>>> choices{masks};   // the orientation that ends first is not always the best one
    for (int parity = 0; parity < 2 && params.quarter_turns; ++parity) choices.push_back(turned_alike(masks, parity));
    Nest best;
    const auto attempt = [&] {
        for (const std::vector<std::vector<NestMask>>& choice : choices) {
            const Nest nest = place_in_order(order, choice, grid);
            const bool shorter = nest.length < best.length - 1e-9 || (nest.length < best.length + 1e-9 && nest.width < best.width);
            if (best.placement.empty() || shorter) best = nest;
        }
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
    double longest = 0;   // piece, in the orientation in which it is shortest
    for (const std::vector<NestMask>& orientations : masks) {
        double shortest = orientations.front().size.x();
        for (const NestMask& mask : orientations) shortest = std::min(shortest, mask.size.x());
        longest = std::max(longest, shortest);
    }
    best.utilisation_bound = std::min(1.0, area / (params.roll_width_mm * longest));
    check_overlaps(pieces, best);
    return best;
}

}  // namespace formwork
