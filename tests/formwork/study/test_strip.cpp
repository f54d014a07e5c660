#include <catch2/catch.hpp>
#include <cstdio>
#include <fstream>
#include <numbers>

#include "formwork/study/clamped_strip.hpp"
#include "formwork/study/tensile.hpp"
#include "tests/paths.hpp"

using namespace formwork;

namespace {

using Row = arcsim::Stiffness4;

/// benchmarks b2_strip, shear halved into this project's convention.
TableStripLaw law_of(const Row& rest, const Row& strained) {
    arcsim::StretchingRows rows;
    rows.fill(strained);
    rows[0] = rest;
    return TableStripLaw(rows, 1);
}
const Row iso_rest{300, 2, 300, 298}, tab_rest{300, 2, 300, 18.75}, tab_max{600, 2, 600, 37.5};
const Row woven_rest{36000, 1000, 64000, 1000}, woven_max{360000, 10000, 640000, 10000};

StripState pull(const StripLaw& law, double angle_deg, double strain, int cells, int increments, double* half_width = nullptr) {
    ClampedStrip strip(make_strip(0.04, 0.02, cells), angle_deg * std::numbers::pi / 180);
    StripState s = strip.at_rest();
    for (int i = 1; i <= increments; ++i) s = strip.pull_to(law, s, 0.04 * strain * i / increments);
    if (half_width) *half_width = strip.mid_half_width(s);
    return s;
}

TableStripLaw table3() {
    arcsim::StretchingRows rows{Row(36496.94, 17.77, 56329.3, 3171.91),     Row(453939.78, 24.67, 499773.53, 10794.15),
                                Row(321081.07, 37.87, 643526.19, 46434.4),  Row(147439.0, 11.5, 261801.58, 13953.55),
                                Row(439895.04, 52.62, 383126.43, 12605.24), Row(418775.97, 82.44, 488043.68, 44474.28)};
    return TableStripLaw(rows, 2);
}

}  // namespace

TEST_CASE("a strip between clamps pulls as the reference solutions say (B2, 1000 to 1700 nodes)") {
    struct Case {
        Row rest, strained;
        double angle, strain, force, half_width, tolerance;
        int increments;
    };
    const Case cases[] = {{iso_rest, iso_rest, 0, 0.05, 0.322863039308067, 0.009996534094492415, 1e-5, 1},
                          {iso_rest, iso_rest, 0, 0.2, 1.583944617868388, 0.0099852975, 1e-5, 4},
                          {tab_rest, tab_rest, 45, 0.05, 0.047617146, 0.0093487901, 2e-3, 10},
                          {tab_rest, tab_rest, 45, 0.2, 0.25692237, 0.0068767216, 2e-3, 40},
                          {tab_rest, tab_max, 0, 0.1, 1.1087838, 0.0099956237, 1e-5, 2},
                          {tab_rest, tab_max, 0, 0.2, 3.1679706, 0.0099926818, 1e-5, 4},
                          {woven_rest, woven_rest, 0, 0.02, 14.828718, 0.0099968431, 1e-5, 1},
                          {woven_rest, woven_rest, 90, 0.05, 68.853299, 0.0099857532, 1e-5, 1},
                          {woven_rest, woven_max, 0, 0.05, 143.30287, 0.0099919886, 1e-5, 1}};
    for (const Case& c : cases) {
        double half_width = 0;
        // Off the axes the corners of the clamps are more singular.
        const int cells = c.angle == 0 || c.angle == 90 ? 8 : 10;
        const StripState s = pull(law_of(c.rest, c.strained), c.angle, c.strain, cells, c.increments, &half_width);
        INFO("angle " << c.angle << " strain " << c.strain);
        CHECK(s.force == Approx(c.force).epsilon(c.tolerance));
        CHECK(half_width == Approx(c.half_width).epsilon(c.tolerance));
    }
}

TEST_CASE("the tangent gives the strip's stiffness, and the adjoint its sensitivities") {
    const TableStripLaw law = table3();
    ClampedStrip strip(make_strip(0.04, 0.02, 3), 0.4);
    const StripState s = strip.pull_to(law, strip.at_rest(), 1e-3);
    const double h = 1e-7;
    const double more = strip.pull_to(law, s, 1e-3 + h).force, less = strip.pull_to(law, s, 1e-3 - h).force;
    CHECK(s.stiffness == Approx((more - less) / (2 * h)).epsilon(1e-5));

    const arcsim::VectorXd dF = strip.force_sensitivity(law, s);
    const std::vector<double> p = law.parameters();
    double largest = 0;
    for (int j = 0; j < 24; ++j) largest = std::max(largest, std::abs(dF[j] * p[j]));
    for (int j = 0; j < 24; ++j) {
        std::vector<double> up = p, down = p;
        const double step = 1e-4 * p[j];
        up[j] += step;
        down[j] -= step;
        const double slope = (strip.pull_to(*law.with(up), s, 1e-3).force - strip.pull_to(*law.with(down), s, 1e-3).force) / (2 * step);
        INFO(law.parameter_name(j));
        CHECK(std::abs(dF[j] - slope) * p[j] < 1e-5 * largest);
    }
}

TEST_CASE("a prescribed force finds the displacement that would have given it") {
    const TableStripLaw law = table3();
    ClampedStrip strip(make_strip(0.04, 0.02, 4), 0.3);
    const StripState moved = strip.pull_to(law, strip.at_rest(), 8e-4);
    const StripState loaded = strip.load_to(law, strip.at_rest(), moved.force);
    CHECK(loaded.displacement == Approx(8e-4).epsilon(1e-8));
    CHECK(loaded.force == Approx(moved.force).epsilon(1e-10));
}

TEST_CASE("a curve ends at the breaking force exactly, in time with the clamp") {
    TensileParams p;
    p.material.data = {"woven_table3.json", project_dir() + "/conf/materials/woven_table3.json"};
    p.angles_deg = {0, 22.5, 45};
    p.max_strain = 0.3;
    p.steps = 6;
    p.resolution = 3;
    p.breaking_force_N = 350;
    for (const TensileCurve& c : run_tensile(p)) {
        INFO(c.angle_deg);
        REQUIRE(c.broke);
        CHECK(c.points.back().force_N == Approx(350).epsilon(1e-9));
        for (size_t i = 0; i < c.points.size(); ++i) {
            const TensilePoint& t = c.points[i];
            CHECK(t.time_s == Approx(60 * t.displacement_mm / 2));   // 2 mm/min
            if (i > 0) CHECK(t.force_N > c.points[i - 1].force_N);
            if (i + 1 < c.points.size()) CHECK(t.displacement_mm == Approx(2.0 * static_cast<double>(i + 1)));
        }
    }
    p.control = TensileControl::force;
    const std::vector<TensileCurve> by_force = run_tensile(p);
    p.control = TensileControl::displacement;
    const std::vector<TensileCurve> by_displacement = run_tensile(p);
    for (size_t i = 0; i < by_force.size(); ++i) {
        CHECK(by_force[i].broke);
        CHECK(by_force[i].points.back().displacement_mm == Approx(by_displacement[i].points.back().displacement_mm).epsilon(1e-6));
    }
}

TEST_CASE("a measured history of forces is followed in its own time") {
    const std::string file = "measured_history_test.csv";
    std::ofstream(file) << "angle_deg,displacement_mm,force_N,time_s\n0,0.05,4,1\n0,0.1,9,2.5\n0,0.2,20,7\n";
    TensileParams p;
    p.material.data = {"woven_table3.json", project_dir() + "/conf/materials/woven_table3.json"};
    p.measured = arcsim::InputFile{file, file};
    p.control = TensileControl::force;
    p.resolution = 3;
    const std::vector<TensileCurve> curves = run_tensile(p);
    std::remove(file.c_str());
    REQUIRE(curves.size() == 1);
    REQUIRE(curves[0].points.size() == 3);
    const double force[] = {4, 9, 20}, time[] = {1, 2.5, 7};
    for (int i = 0; i < 3; ++i) {
        CHECK(curves[0].points[i].force_N == Approx(force[i]));
        CHECK(curves[0].points[i].time_s == Approx(time[i]));
    }
    CHECK(curves[0].misfit >= 0);
}

TEST_CASE("an isotropic strip does not care how it was cut, and equals the tensor with k_ss = k_uu - k_uv") {
    const IsotropicStripLaw isotropic({300, 20, 600, 40}, 1);
    const TableStripLaw tensor = law_of({300, 20, 300, 280}, {600, 40, 600, 560});
    const double straight = pull(isotropic, 0, 0.1, 4, 2).force;
    CHECK(pull(isotropic, 33, 0.1, 4, 2).force == Approx(straight).epsilon(1e-9));
    CHECK(pull(tensor, 0, 0.1, 4, 2).force == Approx(straight).epsilon(1e-6));
}
