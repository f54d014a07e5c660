#include "formwork/study/sweep_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"

namespace formwork {

using arcsim::InputError;

void visit(arcsim::Archive& a, SweepParameter& p) {
    a.required("key", p.key, "Key of the scene, as for --set: a path below `formwork`, or from the root with a leading /.");
    a.optional("values", p.values, "Numbers that the key takes.");
    a.optional("words", p.words, "Values that are not numbers: JSON text, or plain words.");
    a.optional("from", p.from, "Lower end of a range of numbers.");
    a.optional("to", p.to, "Upper end of a range of numbers.");
    a.optional("count", p.count, "", arcsim::non_negative, "How many values the range gives (grid and zip).");
    a.optional("logarithmic", p.logarithmic, "Space the range by ratios instead of differences.");
    const int kinds = !p.values.empty() + !p.words.empty() + (p.from && p.to);
    a.check(kinds == 1, "key", "Give exactly one of `values`, `words`, or `from` with `to`.");
    a.check(!p.logarithmic || !p.from || (*p.from > 0 && *p.to > 0), "logarithmic",
            "A logarithmic range needs ends above zero.");
}

void visit(arcsim::Archive& a, SweepListPoint& p) {
    a.required("set", p.set, "Overrides of this point, each `key=value`.");
}

void visit(arcsim::Archive& a, SweepChart& c) {
    a.required("x", c.x, "Column of results.csv along the horizontal axis.");
    a.required("y", c.y, "Column of results.csv along the vertical axis.");
    a.optional("series", c.series, "Column whose values make separate curves.");
}

void visit(arcsim::Archive& a, SweepParams& p) {
    a.required("scene", p.scene, "The scene that every point starts from.");
    a.choice("design", p.design, sweep_design_names, "How the parameters are combined.");
    a.list("parameters", p.parameters, "The keys that vary (grid, zip, latin_hypercube).");
    a.list("points", p.points, "The points of a `list` design.");
    a.optional("samples", p.samples, "", arcsim::non_negative, "Number of points of a latin_hypercube.");
    a.optional("seed", p.seed, "", arcsim::non_negative, "Seed of the latin_hypercube.");
    a.optional("processes", p.processes, "", arcsim::non_negative, "Points that run at once; 0: one per core.");
    a.optional("from", p.from_stage, "First stage to run; empty: the first.");
    a.optional("to", p.to_stage, "Last stage to run; empty: the last.");
    a.list("charts", p.charts, "Charts of the results.");
    a.check(p.design == SweepDesign::list ? !p.points.empty() && p.parameters.empty()
                                          : p.points.empty() && !p.parameters.empty(),
            "design", "A `list` needs `points` and no `parameters`; the other designs need `parameters` and no `points`.");
    a.check(p.design != SweepDesign::latin_hypercube || p.samples > 0, "samples",
            "A latin_hypercube needs `samples` > 0.");
}

namespace {

std::vector<std::string> values_of(const SweepParameter& p) {
    std::vector<std::string> texts = p.words;
    for (double v : p.values) texts.push_back(arcsim::format_number(v));
    if (!p.from) return texts;
    if (p.count < 1)
        throw InputError("/parameters: the range of \"" + p.key + "\" needs a `count` of at least 1.");
    for (int i = 0; i < p.count; ++i) {
        const double t = p.count == 1 ? 0 : static_cast<double>(i) / (p.count - 1);
        const double v = p.logarithmic ? *p.from * std::pow(*p.to / *p.from, t) : *p.from + t * (*p.to - *p.from);
        texts.push_back(arcsim::format_number(v));
    }
    return texts;
}

std::vector<SweepPoint> grid(const SweepParams& p) {
    std::vector<SweepPoint> points(1);
    for (const SweepParameter& parameter : p.parameters) {   // the last parameter varies fastest
        std::vector<SweepPoint> longer;
        for (const SweepPoint& point : points)
            for (const std::string& value : values_of(parameter)) {
                longer.push_back(point);
                longer.back().overrides.emplace_back(parameter.key, value);
            }
        points = std::move(longer);
    }
    return points;
}

std::vector<SweepPoint> zip(const SweepParams& p) {
    std::vector<SweepPoint> points(values_of(p.parameters.front()).size());
    for (const SweepParameter& parameter : p.parameters) {
        const auto values = values_of(parameter);
        if (values.size() != points.size())
            throw InputError("/parameters: in a zip every parameter needs as many values as the first (" +
                             std::to_string(points.size()) + "), but \"" + parameter.key + "\" has " +
                             std::to_string(values.size()) + ".");
        for (std::size_t i = 0; i < points.size(); ++i) points[i].overrides.emplace_back(parameter.key, values[i]);
    }
    return points;
}

/// SplitMix64: the standard library's distributions differ between implementations, this does not.
struct Random {
    std::uint64_t state;
    std::uint64_t next() {
        std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    double unit() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
};

std::vector<SweepPoint> latin_hypercube(const SweepParams& p) {
    std::vector<SweepPoint> points(p.samples);
    Random random{static_cast<std::uint64_t>(p.seed)};
    for (const SweepParameter& parameter : p.parameters) {
        std::vector<int> stratum(p.samples);
        std::iota(stratum.begin(), stratum.end(), 0);
        for (int i = p.samples - 1; i > 0; --i)
            std::swap(stratum[i], stratum[random.next() % static_cast<std::uint64_t>(i + 1)]);
        const auto values = parameter.from ? std::vector<std::string>{} : values_of(parameter);
        for (int i = 0; i < p.samples; ++i) {
            const double t = (stratum[i] + random.unit()) / p.samples;
            std::string value;
            if (!parameter.from)
                value = values[std::min(values.size() - 1, static_cast<std::size_t>(t * static_cast<double>(values.size())))];
            else if (parameter.logarithmic)
                value = arcsim::format_number(*parameter.from * std::pow(*parameter.to / *parameter.from, t));
            else
                value = arcsim::format_number(*parameter.from + t * (*parameter.to - *parameter.from));
            points[i].overrides.emplace_back(parameter.key, value);
        }
    }
    return points;
}

std::vector<SweepPoint> listed(const SweepParams& p) {
    std::vector<SweepPoint> points(p.points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        for (const std::string& text : p.points[i].set) {
            const auto equals = text.find('=');
            if (equals == std::string::npos || equals == 0)
                throw InputError("/points/" + std::to_string(i) + "/set: \"" + text + "\" is not of the form key=value.");
            points[i].overrides.emplace_back(text.substr(0, equals), text.substr(equals + 1));
        }
    return points;
}

}  // namespace

std::vector<SweepPoint> plan_points(const SweepParams& p) {
    std::vector<SweepPoint> points = p.design == SweepDesign::grid              ? grid(p)
                                     : p.design == SweepDesign::zip             ? zip(p)
                                     : p.design == SweepDesign::latin_hypercube ? latin_hypercube(p)
                                                                                : listed(p);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].number = static_cast<int>(i);
    return points;
}

}  // namespace formwork
