#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "formwork/panels/paper_sheets.hpp"
#include "formwork/panels/sheet_grid.hpp"

using namespace formwork;

namespace {

/// A rectangle of cloth with 10 mm of allowance, its arrow and its name in the middle.
PatternPiece rectangle(double length, double width) {
    const auto box = [](const Vector2d& half) { return Line{-half, {half.x(), -half.y()}, half, {-half.x(), half.y()}}; };
    PatternPiece p;
    p.name = "P01";
    p.sew = box(Vector2d(length, width) / 2 - Vector2d(10, 10));
    p.cut = box(Vector2d(length, width) / 2);
    p.cut_area = length * width;
    p.grain = {Vector2d(-40, -20), Vector2d(40, -20)};
    p.texts = {{{0, 0}, 5, 0, "P01 of 1", -1}};
    return p;
}

bool shown(const PaperLayout& layout, const Vector2d& point) {
    return std::any_of(layout.sheets.begin(), layout.sheets.end(), [&](const PaperSheet& sheet) {
        return (point.array() >= sheet.window.low.array() - 1e-9).all() && (point.array() <= sheet.window.high.array() + 1e-9).all();
    });
}

}  // namespace

TEST_CASE("sheets inside a piece that would be blank are not printed, and the others hang together") {
    const PatternPiece piece = rectangle(2000, 1500);
    const PaperLayout layout = lay_on_sheets({piece}, {}, Paper::a4);
    CHECK(layout.left_out.size() >= 20);
    CHECK(layout.sheets.size() + layout.left_out.size() <= 8 * 9);   // 2000 / (277 - 10) by 1500 / (190 - 10), and no more

    const PatternPiece& turned = layout.pieces[0];
    const Placement& place = layout.placement[0];
    for (const Line* line : {&turned.cut, &turned.sew})
        for (std::size_t k = 0; k < line->size(); ++k)
            for (double share : {0.0, 0.1, 0.35, 0.5, 0.8})
                CHECK(shown(layout, place((1 - share) * (*line)[k] + share * (*line)[(k + 1) % line->size()])));
    for (const Vector2d& end : turned.grain) CHECK(shown(layout, place(end)));
    CHECK(shown(layout, place(turned.texts[0].at)));

    std::set<std::string> names, reached{layout.sheets.front().name};
    for (const PaperSheet& sheet : layout.sheets) names.insert(sheet.name);
    CHECK(names.size() == layout.sheets.size());
    for (std::size_t before = 0; before != reached.size();) {
        before = reached.size();
        for (const PaperSheet& sheet : layout.sheets)
            for (const std::string& other : sheet.neighbour) {
                if (other.empty()) continue;
                CHECK(names.count(other) == 1);   // no diamond leads to a sheet that is not there
                if (reached.count(other)) reached.insert(sheet.name);
            }
    }
    CHECK(reached == names);
}

TEST_CASE("pieces that fit on a sheet lie on it whole, side by side") {
    const PaperLayout layout = lay_on_sheets({rectangle(180, 120), rectangle(180, 120)}, {}, Paper::a4);
    CHECK(layout.sheets.size() == 1);
    CHECK_FALSE(layout.sheets.front().is_glued());
    CHECK(layout.left_out.empty());
}

TEST_CASE("rows of sheets are counted like the columns of a table") {
    CHECK(row_letters(0) == "A");
    CHECK(row_letters(25) == "Z");
    CHECK(row_letters(26) == "AA");
}
