#include "formwork/study/study_files.hpp"

#include <map>
#include <sstream>

#include "arcsim/base/files.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/report/chart.hpp"

namespace formwork {

using arcsim::JsonValue;

JsonValue write_tensile(const std::filesystem::path& dir, const std::vector<TensileCurve>& curves, bool with_measured) {
    const std::filesystem::path folder = dir / "tensile";
    std::vector<ChartSeries> series;
    JsonValue list = JsonValue::array();
    for (size_t i = 0; i < curves.size(); ++i) {
        const TensileCurve& c = curves[i];
        ChartSeries line{arcsim::format_short(c.angle_deg) + "°", {0}, {0}, true, false, static_cast<int>(i)};
        ChartSeries dots{arcsim::format_short(c.angle_deg) + "° measured", {}, {}, false, true, static_cast<int>(i)};
        for (const TensilePoint& t : c.points) {
            line.x.push_back(t.displacement_mm);
            line.y.push_back(t.force_N);
            dots.x.push_back(t.measured_displacement_mm);
            dots.y.push_back(t.measured_force_N);
        }
        series.push_back(line);
        if (with_measured) series.push_back(dots);
        JsonValue v = JsonValue::object();
        v.set("angle_deg", c.angle_deg);
        v.set("points", static_cast<int>(c.points.size()));
        v.set("last_displacement_mm", c.points.empty() ? 0.0 : c.points.back().displacement_mm);
        v.set("last_force_N", c.points.empty() ? 0.0 : c.points.back().force_N);
        v.set("initial_stiffness_N_per_mm", c.points.empty() ? 0.0 : c.points.front().stiffness_N_per_mm);
        v.set("broke", c.broke);
        v.set("nodes", c.nodes);
        v.set("iterations", c.iterations);
        if (c.misfit >= 0) v.set("misfit", c.misfit);
        list.add(std::move(v));
    }
    arcsim::write_file_atomically(folder / "tensile.csv", tensile_csv(curves, with_measured));
    arcsim::write_file_atomically(folder / "tensile.png",
                                  encode_png(line_chart(series, "Tensile test: strips cut at an angle to the warp", "displacement, mm", "force, N")));
    JsonValue summary = JsonValue::object();
    summary.set("curves", std::move(list));
    return summary;
}

JsonValue write_fit(const std::filesystem::path& dir, const FitResult& r, double density) {
    const std::filesystem::path folder = dir / "fit";
    std::map<double, std::pair<ChartSeries, ChartSeries>> curves;
    std::ostringstream points;
    points.precision(10);
    points << "angle_deg,displacement_mm,measured_N,fitted_N,deviation_N\n";
    for (const FittedPoint& p : r.points) {
        points << p.angle_deg << ',' << p.displacement_mm << ',' << p.measured_N << ',' << p.fitted_N << ',' << p.deviation_N << '\n';
        const int colour = static_cast<int>(curves.count(p.angle_deg) ? curves.at(p.angle_deg).first.colour : curves.size());
        auto& [fitted, measured] = curves[p.angle_deg];
        fitted.name = arcsim::format_short(p.angle_deg) + "° fitted";
        fitted.colour = measured.colour = colour;
        measured.name = arcsim::format_short(p.angle_deg) + "° measured";
        measured.line = false;
        measured.dots = true;
        fitted.x.push_back(p.displacement_mm);
        fitted.y.push_back(p.fitted_N);
        measured.x.push_back(p.displacement_mm);
        measured.y.push_back(p.measured_N);
    }
    std::vector<ChartSeries> series;
    for (const auto& [angle, pair] : curves) {
        series.push_back(pair.first);
        series.push_back(pair.second);
    }
    arcsim::write_file_atomically(folder / "fit.csv", fit_csv(r));
    arcsim::write_file_atomically(folder / "points.csv", points.str());
    arcsim::write_file_atomically(folder / "fit.png", encode_png(line_chart(series, "Measured and fitted tensile curves", "displacement, mm", "force, N")));
    if (r.entries.size() == 24) arcsim::write_file_atomically(folder / "material.json", fitted_material_text(r, density));

    JsonValue summary = JsonValue::object(), entries = JsonValue::object();
    int determined = 0;
    for (const FittedEntry& e : r.entries) {
        JsonValue v = JsonValue::object();
        v.set("value_N_per_m", e.value);
        v.set("deviation_N_per_m", e.deviation);
        v.set("determined", e.determined);
        v.set("influence", e.influence);
        entries.set(e.name, std::move(v));
        determined += e.determined;
    }
    summary.set("converged", r.converged);
    summary.set("iterations", r.iterations);
    summary.set("strips", r.strips);
    summary.set("chi2_per_point", r.chi2_per_point);
    summary.set("determined", determined);
    summary.set("entries", std::move(entries));
    return summary;
}

}  // namespace formwork
