#include "formwork/panels/glued_sheets.hpp"

#include <algorithm>
#include <cmath>

#include "formwork/panels/nest.hpp"
#include "formwork/panels/sheet_grid.hpp"

namespace formwork {
namespace {

constexpr double between_pieces = 4;   // mm
constexpr int most_rows = 6;           // of a nested grid; longer patterns grow along their columns

Box moved(const Box& box, const Vector2d& by) { return {box.low + by, box.high + by}; }

GluedGrids nested_together(const std::vector<PatternPiece>& large, const PanelParams& params, const Vector2d& room) {
    double narrowest = 0;
    for (const PatternPiece& piece : large) narrowest = std::max(narrowest, bounding_box(piece.cut).size().minCoeff());
    GluedGrids best;
    for (int rows = 1; rows <= most_rows || best.sheets.empty(); ++rows) {
        const double width = rows * (room.y() - sheet_overlap) + sheet_overlap;
        if (width < narrowest) continue;
        const Nest nest = nest_pieces(large, paper_nesting(params, width));
        std::vector<LaidPiece> laid;
        for (std::size_t i = 0; i < large.size(); ++i) laid.push_back({&large[i], nest.placement[i]});
        const SheetGrid grid = grid_for({nest.length, nest.width}, room);
        SheetsInUse sheets = sheets_in_use(grid, laid, 0);
        if (!best.sheets.empty() && sheets.printed.size() >= best.sheets.size()) continue;
        best = {large, nest.placement, std::move(sheets.printed), std::move(sheets.left_out), grid.rows, -grid.size().y()};
    }
    const Vector2d move(0, best.low);
    for (PaperSheet& sheet : best.sheets) sheet.window = moved(sheet.window, move);
    for (Box& window : best.left_out) window = moved(window, move);
    for (Placement& place : best.placement) place.offset += move;
    return best;
}

/// One piece turned and moved on a grid of its own to where the fewest sheets show it.
struct AloneOnGrid {
    PatternPiece piece;
    Placement place;
    SheetGrid grid;
    std::ptrdiff_t sheets = 0;   // with marks
};

AloneOnGrid place_alone(const PatternPiece& piece, const Vector2d& room) {
    constexpr int places = 3;   // along each side of the grid's slack
    constexpr int effort = 400, most_turns = 36;   // windows looked at per place: few turns of huge pieces, all of small ones
    const SheetGrid unturned = grid_for(bounding_box(piece.cut).size(), room);
    const int turns = std::clamp(effort / unturned.count(), 1, most_turns);
    AloneOnGrid best;
    for (int k = 0; k < turns; ++k) {
        const PatternPiece turned = turned_piece(piece, k * M_PI / turns);
        const Box box = bounding_box(turned.cut);
        const SheetGrid grid = grid_for(box.size(), room);
        const Vector2d slack = grid.size() - box.size();
        for (int i = 0; i < places * places; ++i) {
            const Placement place{0, slack.cwiseProduct(Vector2d(i % places, i / places)) / (places - 1) - box.low};
            const std::vector<char> ink = inked(grid, {{&turned, place}});
            const std::ptrdiff_t sheets = std::count(ink.begin(), ink.end(), 1);
            if (best.sheets == 0 || sheets < best.sheets) best = {turned, place, grid, sheets};
        }
    }
    return best;
}

GluedGrids each_alone(const std::vector<PatternPiece>& large, const Vector2d& room) {
    GluedGrids all;
    for (const PatternPiece& piece : large) {
        const AloneOnGrid alone = place_alone(piece, room);
        const Vector2d move(0, all.low - (all.rows > 0 ? between_sheets : 0.0) - alone.grid.size().y());
        SheetsInUse sheets = sheets_in_use(alone.grid, {{&alone.piece, alone.place}}, all.rows);
        for (PaperSheet& sheet : sheets.printed) {
            sheet.window = moved(sheet.window, move);
            all.sheets.push_back(std::move(sheet));
        }
        for (const Box& window : sheets.left_out) all.left_out.push_back(moved(window, move));
        all.pieces.push_back(alone.piece);
        all.placement.push_back({0, alone.place.offset + move});
        all.rows += alone.grid.rows;
        all.low = move.y();
    }
    return all;
}

}  // namespace

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
