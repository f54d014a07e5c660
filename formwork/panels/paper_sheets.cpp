#include "formwork/panels/paper_sheets.hpp"

#include <algorithm>
#include <cmath>

#include "formwork/panels/glued_sheets.hpp"
#include "formwork/panels/nest.hpp"
#include "formwork/panels/sheet_grid.hpp"

namespace formwork {
namespace {

Vector2d paper_size(Paper paper) {   // mm
    switch (paper) {
        case Paper::a4: return {210, 297};
        case Paper::letter: return {215.9, 279.4};
        case Paper::a3: return {297, 420};
        case Paper::a0: return {841, 1189};
    }
    return {210, 297};
}

bool fits_on(const Vector2d& room, const Polygon& cut) {
    const Vector2d size = bounding_box(cut).size();
    return size.minCoeff() <= room.minCoeff() && size.maxCoeff() <= room.maxCoeff();
}

/// The piece as it is, or turned by the first angle at which it fits on a sheet.
PatternPiece turned_to_fit(const PatternPiece& piece, const Vector2d& room) {
    constexpr int tries = 45;   // of a quarter turn
    if (fits_on(room, piece.cut)) return piece;
    for (int k = 1; k < tries; ++k) {
        const PatternPiece turned = turned_piece(piece, k * M_PI / 2 / tries);
        if (fits_on(room, turned.cut)) return turned;
    }
    return piece;
}

std::vector<PatternPiece> chosen(const std::vector<PatternPiece>& pieces, const std::vector<int>& which) {
    std::vector<PatternPiece> some;
    for (int i : which) some.push_back(pieces[i]);
    return some;
}

/// Pieces that each fit on a sheet, packed onto as few as first fit finds; `fits` tells whether some do on one.
template <class Fits>
std::vector<std::vector<int>> pack(std::vector<int> which, const std::vector<PatternPiece>& pieces, const Fits& fits) {
    std::sort(which.begin(), which.end(), [&](int a, int b) { return pieces[a].cut_area > pieces[b].cut_area; });
    std::vector<std::vector<int>> packs;
    for (int i : which) {
        bool placed = false;
        for (std::vector<int>& pack : packs) {
            pack.push_back(i);
            placed = fits(pack);
            if (placed) break;
            pack.pop_back();
        }
        if (!placed) packs.push_back({i});
    }
    return packs;
}

}  // namespace

PaperLayout lay_on_sheets(const std::vector<PatternPiece>& as_cut, const PanelParams& params, Paper paper) {
    PaperLayout layout;
    layout.paper = paper_size(paper);
    const Vector2d room = layout.paper - Vector2d::Constant(2 * page_margin);
    for (const PatternPiece& piece : as_cut) layout.pieces.push_back(turned_to_fit(piece, room));
    const std::vector<PatternPiece>& pieces = layout.pieces;
    layout.placement.resize(pieces.size());
    std::vector<int> small, large;
    for (std::size_t i = 0; i < pieces.size(); ++i) (fits_on(room, pieces[i].cut) ? small : large).push_back(static_cast<int>(i));

    double below = 0;   // y where the single sheets begin, downwards
    int row = 0;
    if (!large.empty()) {
        GluedGrids grids = lay_on_grids(chosen(as_cut, large), params, room);
        for (std::size_t k = 0; k < large.size(); ++k) {
            layout.pieces[large[k]] = std::move(grids.pieces[k]);
            layout.placement[large[k]] = grids.placement[k];
        }
        layout.sheets = std::move(grids.sheets);
        layout.left_out = std::move(grids.left_out);
        row = grids.rows;
        below = grids.low - between_sheets;
    }

    const auto nested = [&](const std::vector<int>& which) { return nest_pieces(chosen(pieces, which), paper_nesting(params, room.y())); };
    const auto fits = [&](const std::vector<int>& which) {
        double area = 0;
        for (int i : which) area += pieces[i].cut_area;
        return area < room.prod() && nested(which).length <= room.x();
    };
    const std::vector<std::vector<int>> packs = pack(small, pieces, fits);
    const int columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(packs.size()) * room.y() / room.x()))));
    for (std::size_t k = 0; k < packs.size(); ++k) {
        const int column = static_cast<int>(k) % columns, line = static_cast<int>(k) / columns;
        const Vector2d low(column * (room.x() + between_sheets), below - (line + 1) * room.y() - line * between_sheets);
        const Nest nest = nested(packs[k]);
        for (std::size_t i = 0; i < packs[k].size(); ++i) {
            layout.placement[packs[k][i]] = nest.placement[i];
            layout.placement[packs[k][i]].offset += low;
        }
        layout.sheets.push_back({row_letters(row + line) + std::to_string(column + 1), {low, low + room}, {}});
    }

    Box all{layout.sheets.front().window};   // moved so that everything lies at and above zero
    for (const PaperSheet& sheet : layout.sheets) all = {all.low.cwiseMin(sheet.window.low), all.high.cwiseMax(sheet.window.high)};
    for (PaperSheet& sheet : layout.sheets) sheet.window = {sheet.window.low - all.low, sheet.window.high - all.low};
    for (Box& window : layout.left_out) window = {window.low - all.low, window.high - all.low};
    for (Placement& place : layout.placement) place.offset -= all.low;
    layout.size = all.size();
    return layout;
}

PaperLayout lay_on_plotter(const std::vector<PatternPiece>& pieces, const PanelParams& params) {
    PaperLayout layout;
    const double width = paper_size(Paper::a0).x() - 2 * page_margin;
    double narrowest = 0;
    for (const PatternPiece& piece : pieces) narrowest = std::max(narrowest, bounding_box(piece.cut).size().minCoeff());
    const Nest nest = nest_pieces(pieces, paper_nesting(params, narrowest <= width ? width : params.roll_width_mm));
    layout.pieces = pieces;
    layout.placement = nest.placement;
    layout.size = {nest.length, nest.width};
    return layout;
}

}  // namespace formwork
