#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <random>

#include "formwork/study/fit.hpp"
#include "formwork/study/tensile.hpp"
#include "tests/paths.hpp"

using namespace formwork;

namespace {

arcsim::InputFile table3() { return {"woven_table3.json", project_dir() + "/conf/materials/woven_table3.json"}; }

/// Curves of the woven fabric with noise of 1 % (or none), always the same.
std::vector<MeasuredCurve> synthetic(double noise) {
    TensileParams t;
    t.material.data = table3();
    t.max_strain = 0.08;
    t.steps = 5;
    t.resolution = 2;
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::vector<MeasuredCurve> curves;
    for (const TensileCurve& c : run_tensile(t)) {
        MeasuredCurve m{c.angle_deg, {}, {}};
        for (const TensilePoint& p : c.points) {
            m.displacement_mm.push_back(p.displacement_mm);
            m.force_N.push_back(p.force_N * (1 + noise * normal(random)));
        }
        curves.push_back(m);
    }
    return curves;
}

FitParams params() {
    FitParams p;
    p.resolution = 2;
    p.points_per_curve = 5;
    p.noise_floor_N = 1e-6;
    return p;
}

}  // namespace

TEST_CASE("a table is recovered from noisy curves within the stated uncertainty, and what cannot be known is said") {
    const std::vector<double> truth = make_strip_law([] {
                                          MaterialParams m;
                                          m.model = FabricModel::tensor;
                                          m.data = table3();
                                          return m;
                                      }())->parameters();
    const std::vector<MeasuredCurve> curves = synthetic(0.01);
    const FitParams p = params();
    const FitResult r = fit_table(p, curves, start_from_slopes(p, curves));
    REQUIRE(r.converged);
    CHECK(r.chi2_per_point < 2);
    int determined = 0;
    for (int j = 0; j < 24; ++j) {
        const FittedEntry& e = r.entries[j];
        INFO(e.name << " " << e.value << " +- " << e.deviation << ", truth " << truth[j]);
        CHECK(e.why.empty() == e.determined);   // what the data do not say is named with its reason
        if (!e.determined) continue;
        ++determined;
        CHECK(std::abs(e.value - truth[j]) < 3.5 * e.deviation);
    }
    CHECK(determined >= 4);
    CHECK(r.entries[0].determined);         // rest k_uu: the strip along the warp
    CHECK(r.entries[2].determined);         // rest k_vv
    CHECK_FALSE(r.entries[1].determined);   // rest k_uv: a thousandth of k_uu, and no strip is held across
}

TEST_CASE("an isotropic table is recovered from curves without noise") {
    const IsotropicStripLaw truth({300, 60, 600, 90}, 1);
    FitParams p = params();
    p.model = FitModel::isotropic;
    MeasuredCurve c{0, {}, {}};
    ClampedStrip strip(make_strip(0.04, 0.02, p.resolution), 0);
    StripState s = strip.at_rest();
    for (int i = 1; i <= 6; ++i) {
        s = strip.pull_to(truth, s, 0.04 * 0.03 * i);
        c.displacement_mm.push_back(1e3 * s.displacement);
        c.force_N.push_back(s.force);
    }
    const FitResult r = fit_table(p, {c}, start_from_slopes(p, {c}));
    CHECK(r.chi2_per_point < 1e-2);
    const double wanted[] = {300, 60, 600, 90};
    for (int j = 0; j < 4; ++j) CHECK(std::abs(r.entries[j].value - wanted[j]) < r.entries[j].deviation);
    CHECK_FALSE(r.entries[1].determined);   // one strip cannot tell k_uv from k_uu
}

TEST_CASE("measured curves are read by angle, and a bad line is named") {
    const std::string file = "measured_curves_test.csv";
    std::ofstream(file) << "# strips\nangle_deg,displacement_mm,force_N\n0,0.1,5\n45,0.1,1\n0,0.2,11\n";
    const std::vector<MeasuredCurve> curves = read_measured_curves(file);
    REQUIRE(curves.size() == 2);
    CHECK(curves[0].force_N == std::vector<double>{5, 11});
    CHECK(curves[1].angle_deg == 45);
    std::ofstream(file) << "angle_deg,displacement_mm,force_N\n0,0.1,x\n";
    CHECK_THROWS_WITH(read_measured_curves(file), Catch::Contains(":2: expected three numbers"));
    std::ofstream(file) << "angle_deg,displacement_mm,force_N\n0,0.2,1\n0,0.1,2\n";
    CHECK_THROWS_WITH(read_measured_curves(file), Catch::Contains(":3: the displacement goes back"));
    std::ofstream(file) << "angle,mm,N\n";
    CHECK_THROWS_WITH(read_measured_curves(file), Catch::Contains(":1: expected the header"));
    std::remove(file.c_str());
}
