#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "formwork/panels/nest.hpp"
#include "formwork/panels/polygon.hpp"

using namespace formwork;

namespace {

PatternPiece piece(Line outline, int number) {
    PatternPiece p;
    p.panel = number;
    p.name = "P" + std::to_string(number + 1);
    p.cut_area = signed_area(outline);
    p.cut = std::move(outline);
    return p;
}

std::vector<PatternPiece> blobs(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<PatternPiece> pieces;
    for (int k = 0; k < count; ++k) {
        Line outline;
        const double size = 40 + 120 * unit(random), stretch = 0.5 + unit(random), phase = unit(random);
        const int waves = 2 + k % 4;
        for (int i = 0; i < 60; ++i) {
            const double a = 2 * M_PI * i / 60, r = size * (1 + 0.35 * std::sin(waves * a + phase));
            outline.emplace_back(r * std::cos(a), stretch * r * std::sin(a));
        }
        pieces.push_back(piece(outline, k));
    }
    return pieces;
}

}  // namespace

TEST_CASE("nested pieces keep their gap, stay on the roll and keep their grain") {
    for (bool quarter_turns : {false, true}) {
        PanelParams params;
        params.roll_width_mm = 700;
        params.nest_gap_mm = 6;
        params.quarter_turns = quarter_turns;
        const std::vector<PatternPiece> pieces = blobs(14, 5);
        const Nest nest = nest_pieces(pieces, params);
        std::vector<Polygon> laid(pieces.size());
        double area = 0;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            if (!quarter_turns) CHECK(nest.placement[i].quarter_turns % 2 == 0);
            for (const Vector2d& p : pieces[i].cut) laid[i].push_back(nest.placement[i](p));
            const Box box = bounding_box(laid[i]);
            CHECK(box.low.minCoeff() >= -1e-9);
            CHECK(box.high.y() <= 700 + 1e-9);
            CHECK(box.high.x() <= nest.length + 1e-9);
            area += pieces[i].cut_area;
        }
        for (std::size_t i = 0; i < laid.size(); ++i)
            for (std::size_t j = 0; j < laid.size(); ++j) {
                if (i == j) continue;
                CHECK(overlap_area(laid[i], laid[j]) == 0);
                for (const Vector2d& p : laid[i]) CHECK(distance_to_outline(laid[j], p) >= 6 - 0.3);   // between vertices a little less
            }
        CHECK(nest.utilisation == Approx(area / (700 * nest.length)));
        CHECK(nest.utilisation > 0.6);
    }
}

TEST_CASE("two right triangles share one rectangle") {
    PanelParams params;
    params.roll_width_mm = 105;
    params.nest_gap_mm = 1;
    std::vector<PatternPiece> pieces;
    for (int i : {0, 1}) pieces.push_back(piece({{0, 0}, {200, 0}, {0, 100}}, i));
    const Nest nest = nest_pieces(pieces, params);
    CHECK(nest.length < 215);   // side by side they would need 400 mm
    CHECK(nest.placement[0].quarter_turns != nest.placement[1].quarter_turns);
}

TEST_CASE("a roll narrower than a piece is refused with the piece's number and width") {
    PanelParams params;
    params.roll_width_mm = 80;
    const std::vector<PatternPiece> pieces{piece({{0, 0}, {50, 0}, {50, 50}, {0, 50}}, 0), piece({{0, 0}, {60, 0}, {60, 90.5}, {0, 90.5}}, 1)};
    CHECK_THROWS_WITH(nest_pieces(pieces, params), Catch::Contains("panel 2 is 90.5 mm wide") && Catch::Contains("roll_width_mm"));
    params.quarter_turns = true;
    CHECK_NOTHROW(nest_pieces(pieces, params));
}
