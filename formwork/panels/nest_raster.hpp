#pragma once

#include <cstdint>
#include <vector>

#include "formwork/panels/pattern.hpp"

namespace formwork {

/// How finely a roll is divided, and how near pieces may come.
struct NestGrid {
    double width = 0, gap = 0, cell = 1;   // mm
    /// A cell belongs to a piece when its centre is nearer than this: two points of different pieces nearer than
    /// the gap have their midpoint in a cell that both would claim.
    double reach() const;
};

/// One piece in one orientation: the cells that it claims, column by column along the roll.
struct NestMask {
    struct Run {
        int from, to;   // cells across the roll, both claimed
    };
    int quarter_turns = 0;
    Vector2d low{0, 0}, size{0, 0};   // of the turned outline's box, mm
    std::vector<std::vector<Run>> columns;
};
NestMask make_mask(const PatternPiece& piece, int quarter_turns, const NestGrid& grid);

/// `p` turned by 90° times quarter_turns about the origin.
Vector2d quarter_turned(const Vector2d& p, int quarter_turns);

/// Which cells of the roll are taken.
class NestRoll {
public:
    explicit NestRoll(const NestGrid& grid);
    /// The lowest free y for the mask at column x, -1 when there is none.
    int lowest_free(const NestMask& mask, int x) const;
    void occupy(const NestMask& mask, int x, int y);
    int columns() const { return static_cast<int>(used_.size()); }

private:
    using Column = std::vector<std::uint64_t>;   // bits across the roll
    static int highest_in(const Column& column, int from, int to);

    NestGrid grid_;
    std::size_t words_;
    std::vector<Column> used_;
};

}  // namespace formwork
