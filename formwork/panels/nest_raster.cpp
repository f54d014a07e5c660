#include "formwork/panels/nest_raster.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "formwork/panels/polygon.hpp"

namespace formwork {

double NestGrid::reach() const { return gap / 2 + cell * std::sqrt(0.5); }

Vector2d quarter_turned(const Vector2d& p, int quarter_turns) {
    switch (quarter_turns % 4) {
        case 1: return {-p.y(), p.x()};
        case 2: return -p;
        case 3: return {p.y(), -p.x()};
        default: return p;
    }
}

NestMask make_mask(const PatternPiece& piece, int quarter_turns, const NestGrid& grid) {
    NestMask mask;
    mask.quarter_turns = quarter_turns;
    Polygon outline;
    for (const Vector2d& p : piece.cut) outline.push_back(quarter_turned(p, quarter_turns));
    const Box box = bounding_box(outline);
    mask.low = box.low;
    mask.size = box.size();
    const Polygon grown = inflated(outline, grid.reach());
    const Vector2d origin = box.low - Vector2d::Constant(grid.reach());
    const int n_columns = static_cast<int>(std::ceil((mask.size.x() + 2 * grid.reach()) / grid.cell)) + 1;
    const int height = static_cast<int>(std::ceil((mask.size.y() + 2 * grid.reach()) / grid.cell)) + 1;
    mask.columns.resize(n_columns);
    for (int c = 0; c < n_columns; ++c) {
        const double x = origin.x() + (c + 0.5) * grid.cell;
        std::vector<double> crossings;
        for (std::size_t i = 0; i < grown.size(); ++i) {
            const Vector2d &a = grown[i], &b = grown[(i + 1) % grown.size()];
            if ((a.x() > x) != (b.x() > x)) crossings.push_back(a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x()));
        }
        std::sort(crossings.begin(), crossings.end());
        for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
            mask.columns[c].push_back({std::max(0, static_cast<int>(std::floor((crossings[k] - origin.y()) / grid.cell))),
                                       std::min(height - 1, static_cast<int>(std::ceil((crossings[k + 1] - origin.y()) / grid.cell)))});
    }
    return mask;
}

NestRoll::NestRoll(const NestGrid& grid)
    : grid_(grid), words_(static_cast<std::size_t>(std::ceil((grid.width + 2 * grid.reach()) / grid.cell)) / 64 + 3) {}

/// The highest taken cell between `from` and `to`, -1 when all are free.
int NestRoll::highest_in(const Column& column, int from, int to) {
    const int first = from / 64, last = to / 64;
    for (int w = last; w >= first; --w) {
        std::uint64_t bits = column[w];
        if (w == last) bits &= ~std::uint64_t{0} >> (63 - to % 64);
        if (w == first) bits &= ~std::uint64_t{0} << (from % 64);
        if (bits) return 64 * w + 63 - std::countl_zero(bits);
    }
    return -1;
}

int NestRoll::lowest_free(const NestMask& mask, int x) const {
    const int highest = static_cast<int>((grid_.width - mask.size.y()) / grid_.cell + 1e-9);
    const int n = std::min(static_cast<int>(mask.columns.size()), std::max(0, columns() - x));
    int y = 0;
    for (int c = 0, passed = 0; passed < n; c = (c + 1) % n) {   // a step up has every column looked at again
        ++passed;
        for (const NestMask::Run& run : mask.columns[c]) {
            const int taken = highest_in(used_[x + c], y + run.from, y + run.to);
            if (taken < 0) continue;
            y = taken + 1 - run.from;
            passed = 0;
            if (y > highest) return -1;
        }
    }
    return y <= highest ? y : -1;
}

void NestRoll::occupy(const NestMask& mask, int x, int y) {
    if (used_.size() < x + mask.columns.size()) used_.resize(x + mask.columns.size(), Column(words_, 0));
    for (std::size_t c = 0; c < mask.columns.size(); ++c)
        for (const NestMask::Run& run : mask.columns[c])
            for (int r = y + run.from; r <= y + run.to; ++r) used_[x + c][r / 64] |= std::uint64_t{1} << (r % 64);
}

}  // namespace formwork
