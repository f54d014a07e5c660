#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "formwork/flatten/flatten.hpp"
#include "formwork/panels/allowance.hpp"

using namespace formwork;

TEST_CASE("a square with four allowances becomes the rectangle with mitred corners") {
    const Polygon square{{0, 0}, {100, 0}, {100, 100}, {0, 100}};
    const Polygon cut = cut_line(square, {10, 10, 30, 5}, Corner::mitre, 4);   // bottom, right, top, left
    const Box box = bounding_box(cut);
    CHECK(box.low.x() == Approx(-5).margin(1e-3));
    CHECK(box.low.y() == Approx(-10).margin(1e-3));
    CHECK(box.high.x() == Approx(110).margin(1e-3));
    CHECK(box.high.y() == Approx(130).margin(1e-3));
    CHECK(signed_area(cut) == Approx(115.0 * 140).epsilon(1e-5));
    const Polygon bevelled = cut_line(square, {10, 10, 10, 10}, Corner::bevel, 4);
    CHECK(signed_area(bevelled) == Approx(120.0 * 120 - 4 * 50).epsilon(1e-5));
}

TEST_CASE("a sharp corner is bevelled beyond the mitre limit") {
    const Polygon wedge{{0, 0}, {100, -5}, {100, 5}};
    const Polygon cut = cut_line(wedge, {10, 10, 10}, Corner::mitre, 2);
    CHECK(bounding_box(cut).low.x() > -10);
}

TEST_CASE("the cut line keeps its allowance from the sew line on wavy outlines, and never crosses itself") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int trial = 0; trial < 200; ++trial) {
        Polygon sew;
        const int n = 12 + 4 * (trial % 20), waves = 2 + trial % 7;
        const double depth = 0.6 * unit(random), phase = unit(random);
        for (int i = 0; i < n; ++i) {
            const double a = 2 * M_PI * i / n, r = 100 * (1 + depth * std::sin(waves * a + phase) + 0.02 * unit(random));
            sew.emplace_back(r * std::cos(a), r * std::sin(a));
        }
        std::vector<double> allowance(n);
        for (int i = 0; i < n; ++i) allowance[i] = i < n / 3 ? 10 : i < n / 2 ? 30 : 15;
        const Polygon cut = cut_line(sew, allowance, Corner::mitre, 2);
        INFO("trial " << trial);
        REQUIRE(cut.size() >= 3);
        CHECK(signed_area(cut) > signed_area(sew) + 9.9 * perimeter(sew) * 0.3);
        CHECK(outline_crossings(cut).empty());
        double nearest = 1e9;
        for (int i = 0; i < n; ++i)
            for (double t : {0.1, 0.5, 0.9}) {
                const Vector2d p = sew[i] + t * (sew[(i + 1) % n] - sew[i]);
                REQUIRE(contains(cut, p));
                nearest = std::min(nearest, distance_to_outline(cut, p));
            }
        CHECK(nearest > 4.9);   // of 10: a bevel of two allowances that turn by 120° comes no nearer than half
        // Away from steps and corners the distance is the allowance itself.
        const Vector2d middle = (sew[n / 6] + sew[n / 6 + 1]) / 2;
        const Vector2d d = (sew[n / 6 + 1] - sew[n / 6]).normalized();
        CHECK(ray_to_outline(cut, middle, {d.y(), -d.x()}).value() >= 10 - 1e-3);
    }
}

TEST_CASE("a hem's ends are the mirror images of the seams beside it") {
    // A trapezium, 100 wide at the foot and 60 or 140 at the rim; folded about the rim, the hem must lie on the piece.
    for (double half : {30.0, 50.0, 70.0}) {
        const Polygon sew{{-50, 0}, {50, 0}, {half, 120}, {-half, 120}};
        const Polygon cut = cut_line(sew, {10, 10, 30, 10}, Corner::mitre, 2, {0, 0, 1, 0});
        CHECK(outline_crossings(cut).empty());
        for (double below : {0.5, 10.0, 20.0, 29.5}) {
            const auto right_end = [&](double y) { return ray_to_outline(cut, {0, y}, {1, 0}).value(); };
            const auto left_end = [&](double y) { return ray_to_outline(cut, {0, y}, {-1, 0}).value(); };
            INFO("rim " << 2 * half << " mm, " << below << " mm from the fold");
            CHECK(right_end(120 + below) == Approx(right_end(120 - below)).margin(2e-3));
            CHECK(left_end(120 + below) == Approx(left_end(120 - below)).margin(2e-3));
        }
        CHECK(bounding_box(cut).high.y() == Approx(150).margin(1e-3));
    }
    // Where the seam bends towards its end the allowance stays whole up to the fold, without a slit.
    const Polygon bent{{-50, 0}, {50, 0}, {52, 90}, {54, 110}, {59, 120}, {-59, 120}, {-54, 110}, {-52, 90}};
    const Polygon around = cut_line(bent, {10, 10, 10, 10, 30, 10, 10, 10}, Corner::mitre, 2, {0, 0, 0, 0, 1, 0, 0, 0});
    for (std::size_t i = 1; i < 4; ++i)
        for (double t = 0.02; t < 1; t += 0.07) {
            const Vector2d d = (bent[i + 1] - bent[i]).normalized(), p = bent[i] + t * (bent[i + 1] - bent[i]);
            for (double out = 0.5; out < 10; out += 0.5) CHECK(contains(around, p + out * Vector2d(d.y(), -d.x())));
        }
    for (double x = -58; x < 59; x += 4)
        for (double out = 0.5; out < 30; out += 2) CHECK((contains(around, {x, 120 + out}) || std::abs(x) > 50));
    // Two hems with a dart between them: neither end takes away cloth of the other hem.
    const Polygon darted{{0, 0}, {100, 0}, {100, 80}, {52, 80}, {50, 20}, {48, 80}, {0, 80}};
    const Polygon cut = cut_line(darted, {10, 10, 30, 10, 10, 30, 10}, Corner::mitre, 2, {0, 0, 1, 0, 0, 1, 0});
    CHECK(contains(cut, {5, 109}));
    CHECK(contains(cut, {95, 109}));
    CHECK(contains(cut, {40, 109}));
    CHECK(contains(cut, {60, 109}));
}
