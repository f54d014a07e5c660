#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "arcsim/base/error.hpp"
#include "formwork/report/pictures.hpp"
#include "tests/formwork/synthetic_bag.hpp"
#include "tests/output_folder.hpp"

using namespace formwork;

namespace {

double luminance(const Rgb& c) {
    return 0.2126 * std::pow(c.r, 2.2) + 0.7152 * std::pow(c.g, 2.2) + 0.0722 * std::pow(c.b, 2.2);
}

double difference(const Rgb& a, const Rgb& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

int count_pixels(const Image& image, const Rgb& colour) {
    return static_cast<int>(
        std::count_if(image.pixel.begin(), image.pixel.end(),
                      [&](const Rgb& p) { return difference(p, colour) < 0.15; }));
}

/// A square of two triangles in the plane x = `at`, facing +x.
void add_square(Surface& s, double at, double half) {
    const int n = s.n_nodes();
    for (const auto& [y, z] : {std::pair{-half, -half}, {half, -half}, {half, half}, {-half, half}})
        s.x.push_back({at, y, z});
    s.faces.push_back({n, n + 1, n + 2});
    s.faces.push_back({n, n + 2, n + 3});
}

}  // namespace

TEST_CASE("both colour maps run evenly in lightness, so that they survive grey print") {
    for (int i = 0; i < 100; ++i) {
        CHECK(luminance(map_colour(ColourMap::sequential, (i + 1) / 100.0)) >
              luminance(map_colour(ColourMap::sequential, i / 100.0)));
        const double a = luminance(map_colour(ColourMap::diverging, i / 200.0)),
                     b = luminance(map_colour(ColourMap::diverging, (i + 1) / 200.0));
        CHECK(b > a);
        // Both ends are equally dark within what the screen's gamut allows.
        CHECK(luminance(map_colour(ColourMap::diverging, 1 - i / 200.0)) == Approx(a).margin(0.04));
    }
}

TEST_CASE("neighbouring classes never share a colour while colours last") {
    std::vector<std::vector<int>> ring(9);
    for (int i = 0; i < 9; ++i) ring[i] = {(i + 1) % 9, (i + 8) % 9, (i + 2) % 9, (i + 7) % 9};
    const std::vector<int> colour = colour_classes(ring);
    for (int i = 0; i < 9; ++i)
        for (const int j : ring[i]) CHECK(colour[i] != colour[j]);
    CHECK(difference(class_colour(colour[0]), class_colour(colour[1])) > 0.2);
}

TEST_CASE("legend ends and ticks are round numbers and cover the data") {
    const ColourScale s = sequential_scale({1.013, 1.2, 1.2871}, "stretch", "-");
    CHECK(s.low <= 1.013);
    CHECK(s.high >= 1.2);
    CHECK(s.high - s.low < 0.32);
    const std::vector<double> ticks = round_ticks(0.98, 1.31, 6);
    CHECK(ticks.size() == 7);
    CHECK(ticks.front() == Approx(1.0));
    CHECK(tick_label(1.25, 0.05) == "1.25");
    CHECK(tick_label(-1500, 500) == "\u22121500");
    CHECK(tick_label(0.00025, 0.00025) == "0.00025");
    const ColourScale constant = sequential_scale({2, 2, 2}, "x", "");
    CHECK(constant.high > constant.low);
    const ColourScale d = diverging_scale({-1.2, 0.4}, "x", "mm");
    CHECK(d.low == -d.high);
}

TEST_CASE("a near face hides a far face and the lines behind it") {
    Surface s;
    add_square(s, 0, 1);
    add_square(s, 0.5, 0.6);
    const Rgb red{1, 0, 0}, green{0, 1, 0};
    Paint paint =
        paint_classes({0, 0, 1, 1}, {{{0.2, 0.3, 0.9}, "far"}, {{0.9, 0.8, 0.2}, "near"}}, "");
    PictureOptions o;
    o.width = 600, o.height = 400, o.azimuths_deg = {0}, o.elevation_deg = 0;
    const Line3 hidden{{{0, -0.3, 0}, {0, 0.3, 0}}, red, 6, 1, {0, 0, 0}};
    const Line3 seen{{{0.5, -0.3, 0.2}, {0.5, 0.3, 0.2}}, green, 6, 1, {0, 0, 0}};
    const Image image = render_surface(s, paint, {hidden, seen}, {}, o);
    CHECK(count_pixels(image, red) == 0);
    CHECK(count_pixels(image, green) > 200);
    CHECK_THROWS_AS(render_surface(s, paint_classes({0}, {}, ""), {}, {}, o),
                    std::invalid_argument);
}

TEST_CASE("a picture into a folder that cannot be written is an input error") {
    const Image image(8, 8);
    CHECK_THROWS_AS(write_png("/proc/no_folder/picture.png", image), arcsim::InputError);
    CHECK(encode_png(image).substr(1, 3) == "PNG");
}

TEST_CASE("every picture of the stages can be drawn and written") {
    const OutputFolder folder("pictures");
    const SyntheticBag bag = make_synthetic_bag(96, 56);
    const Segmentation& g = bag.segmentation;
    const Vector3d up(0, 0, 1);
    std::vector<std::vector<Vector3d>> chains;
    for (const Seam& s : g.seams) {
        chains.emplace_back();
        for (const int i : s.nodes) chains.back().push_back(g.mesh.x[i]);
    }
    const std::pair<const char*, Image> pictures[] = {
        {"stretch", picture_stretch(bag.inflated, bag.strain, up, "Stretch of the inflated bag")},
        {"states", picture_states(bag.inflated, bag.strain, up, "Wrinkles")},
        {"tension", picture_tension(bag.inflated, bag.strain, up, "Tension")},
        {"shear", picture_shear(bag.sewn, bag.sewn_strain, up, "Shear of the sewn bag")},
        {"deviation",
         picture_deviation(bag.sewn, bag.deviation, up, "Sewn bag against the cut surface")},
        {"field", picture_cross_field(g.mesh, g.field_theta, g.direction, g.singularities, up,
                                      "Smoothed cross field")},
        {"curves",
         picture_curves(g.mesh, chains, {chains[0], chains[1]}, g.singularities, up, "Curves")},
        {"panels", picture_panels(g, g.mesh, up, "Panels on the bag")},
        {"flat", picture_flat_panels(g, bag.panels, "Cutting pieces")},
    };
    for (const auto& [name, image] : pictures) {
        INFO(name);
        write_png(folder / (std::string(name) + ".png"), image);
        CHECK(std::filesystem::file_size(folder / (std::string(name) + ".png")) > 20000);
    }
}
