#include "formwork/panels/sheet_grid.hpp"

#include <algorithm>
#include <cmath>

#include "formwork/panels/marks.hpp"

namespace formwork {
namespace {

/// Whether the way from a to b runs through the box (Liang, Barsky).
bool runs_through(const Box& box, const Vector2d& a, const Vector2d& b) {
    double from = 0, to = 1;
    for (int k : {0, 1}) {
        const double d = b[k] - a[k];
        if (d == 0) {
            if (a[k] < box.low[k] || a[k] > box.high[k]) return false;
            continue;
        }
        const double s = (box.low[k] - a[k]) / d, t = (box.high[k] - a[k]) / d;
        from = std::max(from, std::min(s, t));
        to = std::min(to, std::max(s, t));
    }
    return from <= to;
}

/// The part of a sheet inside its frame; at the grid's border all that is printed.
Box frame(const SheetGrid& grid, int column, int row) {
    const Vector2d half = Vector2d::Constant(sheet_overlap / 2);
    Box box = grid.window(column, row);
    box.low += half, box.high -= half;
    if (column == 0) box.low.x() -= half.x();
    if (column == grid.columns - 1) box.high.x() += half.x();
    if (row == grid.rows - 1) box.low.y() -= half.y();
    if (row == 0) box.high.y() += half.y();
    return box;
}

/// Calls visit(line, closed) for every line that is printed of a piece; lettering counts as the box around it.
template <class Visit>
void for_each_mark(const PatternPiece& piece, const Visit& visit) {
    visit(piece.cut, true);
    visit(piece.sew, true);
    for (const NotchMark& notch : piece.notches)
        for (const Line& stroke : notch.strokes) visit(stroke, false);
    visit(Line{piece.grain[0], piece.grain[1]}, false);
    for (const TextMark& text : piece.texts) visit(text_box(text), true);
}

/// How many groups of sheets there are that hang together by their sides.
int count_parts(const SheetGrid& grid, const std::vector<char>& used) {
    std::vector<char> seen(used.size(), 0);
    int parts = 0;
    for (int start = 0; start < grid.count(); ++start) {
        if (!used[start] || seen[start]) continue;
        ++parts;
        std::vector<int> open{start};
        seen[start] = 1;
        while (!open.empty()) {
            const int here = open.back(), column = here % grid.columns, row = here / grid.columns;
            open.pop_back();
            const auto reach = [&](int c, int r) {
                if (c < 0 || r < 0 || c >= grid.columns || r >= grid.rows) return;
                const int next = grid.index(c, r);
                if (used[next] && !seen[next]) seen[next] = 1, open.push_back(next);
            };
            reach(column - 1, row), reach(column + 1, row), reach(column, row - 1), reach(column, row + 1);
        }
    }
    return parts;
}

/// Sheets that a piece covers, marked or not.
std::vector<char> covered(const SheetGrid& grid, const std::vector<LaidPiece>& laid) {
    std::vector<char> used = inked(grid, laid);
    for (const LaidPiece& l : laid) {
        Polygon cut;
        for (const Vector2d& p : l.piece->cut) cut.push_back(l.place(p));
        for (int row = 0; row < grid.rows; ++row)
            for (int column = 0; column < grid.columns; ++column) {
                const Box box = frame(grid, column, row);   // no outline runs through a blank one: any of its points tells
                char& use = used[grid.index(column, row)];
                use = use || contains(cut, (box.low + box.high) / 2);
            }
    }
    return used;
}

}  // namespace

Box SheetGrid::window(int column, int row) const {
    const Vector2d low(column * step().x(), (rows - 1 - row) * step().y());
    return {low, low + room};
}

SheetGrid grid_for(const Vector2d& size, const Vector2d& room) {
    const auto count = [](double length, double sheet) {
        return std::max(1, static_cast<int>(std::ceil((length - sheet_overlap) / (sheet - sheet_overlap))));
    };
    return {room, count(size.x(), room.x()), count(size.y(), room.y())};
}

std::vector<char> inked(const SheetGrid& grid, const std::vector<LaidPiece>& laid) {
    std::vector<char> ink(grid.count(), 0);
    const Vector2d step = grid.step();
    const auto draw = [&](const Vector2d& a, const Vector2d& b) {
        const Vector2d low = a.cwiseMin(b) - Vector2d::Constant(sheet_overlap), high = a.cwiseMax(b);
        const auto column = [&](double x) { return std::clamp(static_cast<int>(x / step.x()), 0, grid.columns - 1); };
        const auto row = [&](double y) { return grid.rows - 1 - std::clamp(static_cast<int>(y / step.y()), 0, grid.rows - 1); };
        for (int r = row(high.y()); r <= row(low.y()); ++r)
            for (int c = column(low.x()); c <= column(high.x()); ++c) {
                char& sheet = ink[grid.index(c, r)];
                sheet = sheet || runs_through(frame(grid, c, r), a, b);
            }
    };
    for (const LaidPiece& l : laid)
        for_each_mark(*l.piece, [&](const Line& line, bool closed) {
            for (std::size_t k = 0; k + 1 < line.size(); ++k) draw(l.place(line[k]), l.place(line[k + 1]));
            if (closed) draw(l.place(line.back()), l.place(line.front()));
        });
    return ink;
}

SheetsInUse sheets_in_use(const SheetGrid& grid, const std::vector<LaidPiece>& laid, int first_row) {
    const std::vector<char> ink = inked(grid, laid), cover = covered(grid, laid);
    std::vector<char> used = cover;
    const int parts = count_parts(grid, used);
    for (int i = 0; i < grid.count(); ++i) {
        if (!used[i] || ink[i]) continue;
        used[i] = 0;
        if (count_parts(grid, used) > parts) used[i] = 1;
    }
    const auto name = [&](int column, int row) {
        const bool exists = column >= 0 && row >= 0 && column < grid.columns && row < grid.rows;
        return exists && used[grid.index(column, row)] ? row_letters(first_row + row) + std::to_string(column + 1) : std::string();
    };
    SheetsInUse sheets;
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
            if (const std::string own = name(column, row); !own.empty())
                sheets.printed.push_back({own, grid.window(column, row),
                                          {name(column - 1, row), name(column + 1, row), name(column, row - 1), name(column, row + 1)}});
            else if (cover[grid.index(column, row)])
                sheets.left_out.push_back(grid.window(column, row));
        }
    return sheets;
}

std::string row_letters(int row) {
    std::string name;
    for (int r = row; r >= 0; r = r / 26 - 1) name.insert(name.begin(), static_cast<char>('A' + r % 26));
    return name;
}

}  // namespace formwork
