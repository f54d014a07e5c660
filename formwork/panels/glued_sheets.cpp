#include "formwork/panels/glued_sheets.hpp"

#include <algorithm>
#include <cmath>

#include "formwork/panels/nest.hpp"

namespace formwork {
namespace {

constexpr double between_pieces = 4;   // mm
constexpr int most_rows = 6;           // of a nested grid; longer patterns grow along their columns

/// Windows in rows and columns, each sharing its overlap with the next, from (0, 0) up to the size.
struct Grid {
    Vector2d room;
    int columns, rows;
    Vector2d step() const { return room - Vector2d::Constant(sheet_overlap); }
    Vector2d size() const { return Vector2d(columns, rows).cwiseProduct(step()) + Vector2d::Constant(sheet_overlap); }
    Box window(int column, int row) const {   // row 0 is at the top
        const Vector2d low(column * step().x(), (rows - 1 - row) * step().y());
        return {low, low + room};
    }
};

Grid grid_for(const Vector2d& size, const Vector2d& room) {
    const auto count = [](double length, double sheet) {
        return std::max(1, static_cast<int>(std::ceil((length - sheet_overlap) / (sheet - sheet_overlap))));
    };
    return {room, count(size.x(), room.x()), count(size.y(), room.y())};
}

bool shows(const Box& w, const std::vector<Polygon>& laid) {
    const Polygon box{w.low, {w.high.x(), w.low.y()}, w.high, {w.low.x(), w.high.y()}};
    return std::any_of(laid.begin(), laid.end(), [&](const Polygon& cut) { return overlap_area(cut, box) > 0; });
}

/// The sheets of a grid that show something, with their neighbours.
std::vector<PaperSheet> sheets_in_use(const Grid& grid, const std::vector<Polygon>& laid, int first_row) {
    const auto name = [&](int column, int row) {
        const bool exists = column >= 0 && row >= 0 && column < grid.columns && row < grid.rows;
        return exists && shows(grid.window(column, row), laid) ? row_letters(first_row + row) + std::to_string(column + 1) : std::string();
    };
    std::vector<PaperSheet> sheets;
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column)
            if (const std::string own = name(column, row); !own.empty())
                sheets.push_back({own, grid.window(column, row),
                                  {name(column - 1, row), name(column + 1, row), name(column, row - 1), name(column, row + 1)}});
    return sheets;
}

GluedGrids nested_together(const std::vector<PatternPiece>& large, const PanelParams& params, const Vector2d& room) {
    double narrowest = 0;
    for (const PatternPiece& piece : large) narrowest = std::max(narrowest, bounding_box(piece.cut).size().minCoeff());
    GluedGrids best;
    for (int rows = 1; rows <= most_rows || best.sheets.empty(); ++rows) {
        const double width = rows * (room.y() - sheet_overlap) + sheet_overlap;
        if (width < narrowest) continue;
        const Nest nest = nest_pieces(large, paper_nesting(params, width));
        std::vector<Polygon> laid(large.size());
        for (std::size_t i = 0; i < large.size(); ++i)
            for (const Vector2d& p : large[i].cut) laid[i].push_back(nest.placement[i](p));
        const Grid grid = grid_for({nest.length, nest.width}, room);
        std::vector<PaperSheet> sheets = sheets_in_use(grid, laid, 0);
        if (!best.sheets.empty() && sheets.size() >= best.sheets.size()) continue;
        best = {large, nest.placement, std::move(sheets), grid.rows, -grid.size().y()};
    }
    for (PaperSheet& sheet : best.sheets) sheet.window = {sheet.window.low + Vector2d(0, best.low), sheet.window.high + Vector2d(0, best.low)};
    for (Placement& place : best.placement) place.offset.y() += best.low;
    return best;
}

/// One piece turned and moved on a grid of its own to where the fewest sheets show it.
struct AloneOnGrid {
    PatternPiece piece;
    Vector2d offset;
    Grid grid;
    std::vector<Polygon> laid;   // the piece's cut line
    std::size_t sheets = 0;
};

AloneOnGrid place_alone(const PatternPiece& piece, const Vector2d& room) {
    constexpr int places = 3;   // along each side of the grid's slack
    constexpr int effort = 400, most_turns = 36;   // windows looked at per place: few turns of huge pieces, all of small ones
    const Grid unturned = grid_for(bounding_box(piece.cut).size(), room);
    const int turns = std::clamp(effort / (unturned.columns * unturned.rows), 1, most_turns);
    AloneOnGrid best;
    for (int k = 0; k < turns; ++k) {
        const PatternPiece turned = turned_piece(piece, k * M_PI / turns);
        const Box box = bounding_box(turned.cut);
        const Grid grid = grid_for(box.size(), room);
        const Vector2d slack = grid.size() - box.size();
        for (int i = 0; i < places * places; ++i) {
            const Vector2d offset = slack.cwiseProduct(Vector2d(i % places, i / places)) / (places - 1) - box.low;
            std::vector<Polygon> laid(1);
            for (const Vector2d& p : turned.cut) laid[0].push_back(p + offset);
            std::size_t sheets = 0;
            for (int row = 0; row < grid.rows; ++row)
                for (int column = 0; column < grid.columns; ++column) sheets += shows(grid.window(column, row), laid);
            if (best.sheets == 0 || sheets < best.sheets) best = {turned, offset, grid, std::move(laid), sheets};
        }
    }
    return best;
}

GluedGrids each_alone(const std::vector<PatternPiece>& large, const Vector2d& room) {
    GluedGrids all;
    for (const PatternPiece& piece : large) {
        const AloneOnGrid alone = place_alone(piece, room);
        const Vector2d move(0, all.low - (all.rows > 0 ? between_sheets : 0.0) - alone.grid.size().y());
        for (PaperSheet& sheet : sheets_in_use(alone.grid, alone.laid, all.rows)) {
            sheet.window = {sheet.window.low + move, sheet.window.high + move};
            all.sheets.push_back(std::move(sheet));
        }
        all.pieces.push_back(alone.piece);
        all.placement.push_back({0, alone.offset + move});
        all.rows += alone.grid.rows;
        all.low = move.y();
    }
    return all;
}

}  // namespace

std::string row_letters(int row) {
    std::string name;
    for (int r = row; r >= 0; r = r / 26 - 1) name.insert(name.begin(), static_cast<char>('A' + r % 26));
    return name;
}

PanelParams paper_nesting(const PanelParams& params, double width) {
    PanelParams p = params;
    p.roll_width_mm = width;
    p.nest_gap_mm = between_pieces;
    p.quarter_turns = true;
    return p;
}

GluedGrids lay_on_grids(const std::vector<PatternPiece>& large, const PanelParams& params, const Vector2d& room) {
    GluedGrids together = nested_together(large, params, room), alone = each_alone(large, room);
    return alone.sheets.size() < together.sheets.size() ? alone : together;
}

}  // namespace formwork
