#pragma once

#include "formwork/panels/paper_sheets.hpp"

namespace formwork {

/// Sheets of paper in rows and columns, each sharing its overlap with the next, from (0, 0) up to the size. The frame that
/// is drawn on every sheet lies in the middle of the overlaps: frames tile the grid, so that each mark has one sheet of its own.
struct SheetGrid {
    Vector2d room;   // printable part of a sheet, mm
    int columns, rows;

    Vector2d step() const { return room - Vector2d::Constant(sheet_overlap); }
    Vector2d size() const { return Vector2d(columns, rows).cwiseProduct(step()) + Vector2d::Constant(sheet_overlap); }
    int count() const { return columns * rows; }
    int index(int column, int row) const { return row * columns + column; }
    Box window(int column, int row) const;   // row 0 is at the top
};

/// The smallest grid that covers the size.
SheetGrid grid_for(const Vector2d& size, const Vector2d& room);

/// A piece of cloth on paper.
struct LaidPiece {
    const PatternPiece* piece;
    Placement place;
};

/// Per sheet of the grid: whether a mark of the pieces is drawn within its frame.
std::vector<char> inked(const SheetGrid& grid, const std::vector<LaidPiece>& laid);

/// The sheets that are printed, and the blank ones inside pieces that are not.
struct SheetsInUse {
    std::vector<PaperSheet> printed;
    std::vector<Box> left_out;   // windows
};

/// All sheets with marks, and of the blank ones under pieces those without which the others would fall apart.
/// @param first_row   number of the grid's top row among all rows of paper
SheetsInUse sheets_in_use(const SheetGrid& grid, const std::vector<LaidPiece>& laid, int first_row);

/// "A", "B" ... "Z", "AA": the name of a row of sheets.
std::string row_letters(int row);

}  // namespace formwork
