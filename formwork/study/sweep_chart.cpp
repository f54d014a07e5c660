#include "formwork/study/sweep_chart.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "arcsim/base/text.hpp"
#include "formwork/report/chart.hpp"

namespace formwork {
namespace {

std::optional<double> number_in(const std::string& cell) {
    double v = 0;
    if (!arcsim::parse_number(cell, v) || !std::isfinite(v)) return {};
    return v;
}

/// Curves are lines through their points from left to right.
void sort_by_x(ChartSeries& s) {
    std::vector<std::size_t> order(s.x.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return s.x[a] < s.x[b]; });
    ChartSeries sorted = s;
    for (std::size_t i = 0; i < order.size(); ++i) sorted.x[i] = s.x[order[i]], sorted.y[i] = s.y[order[i]];
    s = std::move(sorted);
}

/// Swept over ratios, shown over ratios.
AxisScale scale_of(const SweepParams& params, const std::string& column) {
    for (const SweepParameter& p : params.parameters)
        if (p.key == column && p.logarithmic) return AxisScale::logarithmic;
    return AxisScale::fitted;
}

std::string file_name(const SweepChart& c) {
    std::string name = c.y + "_over_" + c.x;
    for (char& letter : name)
        if (letter == '/' || letter == '.') letter = '-';
    return name + ".png";
}

std::string missing_column(const SweepTable& results, const std::string& column) {
    const std::string near = arcsim::nearest_word(column, results.columns());
    return "no point has a figure \"" + column + "\", so its chart is not drawn." +
           (near.empty() ? " The first line of results.csv names them all." : " Did you mean \"" + near + "\"?");
}

}  // namespace

std::vector<std::string> draw_sweep_charts(const SweepParams& params, const SweepTable& results,
                                           const std::filesystem::path& out) {
    std::vector<std::string> problems;
    for (const SweepChart& c : params.charts) {
        const std::size_t before = problems.size();
        for (const std::string& column : {c.x, c.y, c.series})
            if (!column.empty() && std::find(results.columns().begin(), results.columns().end(), column) == results.columns().end())
                problems.push_back(missing_column(results, column));
        if (problems.size() > before) continue;

        std::vector<std::string> names;                // in the order of the points
        std::map<std::string, ChartSeries> curves;
        ChartSeries failed{"failed", {}, {}, false, true, 7};
        std::size_t drawn = 0;
        for (std::size_t row = 0; row < results.n_rows(); ++row) {
            const auto x = number_in(results.cell(row, c.x)), y = number_in(results.cell(row, c.y));
            if (!x || !y) continue;
            ++drawn;
            const bool good = results.cell(row, "status") == "done";
            const std::string name = c.series.empty() ? "" : results.cell(row, c.series);
            if (good && !curves.contains(name)) {
                names.push_back(name);
                const std::string label = c.series.empty() ? "" : c.series.substr(c.series.rfind('.') + 1) + " " + name;   // a legend is narrow
                curves[name] = {label, {}, {}, true, true, static_cast<int>(curves.size())};
            }
            ChartSeries& s = good ? curves[name] : failed;
            s.x.push_back(*x);
            s.y.push_back(*y);
        }
        std::vector<ChartSeries> series;
        for (const std::string& name : names) {
            sort_by_x(curves[name]);
            series.push_back(curves[name]);
        }
        if (!failed.x.empty()) series.push_back(failed);
        std::string title = c.y + " over " + c.x;
        if (drawn < results.n_rows())
            title += " (" + std::to_string(results.n_rows() - drawn) + " of " + std::to_string(results.n_rows()) + " points have no figures)";
        write_png(out / "charts" / file_name(c),
                  line_chart(series, title, {c.x, scale_of(params, c.x)}, {c.y, scale_of(params, c.y)}));
    }
    return problems;
}

}  // namespace formwork
