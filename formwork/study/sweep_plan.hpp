#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arcsim/base/archive.hpp"

namespace formwork {

/// How the parameters of a sweep are combined into points.
enum class SweepDesign { grid, zip, latin_hypercube, list };
inline constexpr std::array sweep_design_names{
    arcsim::EnumName{SweepDesign::grid, "grid", "every combination of the values"},
    arcsim::EnumName{SweepDesign::zip, "zip", "the first values together, then the second ones, …"},
    arcsim::EnumName{SweepDesign::latin_hypercube, "latin_hypercube", "`samples` points, each parameter stratified"},
    arcsim::EnumName{SweepDesign::list, "list", "the points as written"}};

/// One key of the scene and the values it takes: `values`, or `words`, or a range.
struct SweepParameter {
    std::string key;                  // a path as for --set
    std::vector<double> values;
    std::vector<std::string> words;   // JSON text, or plain words
    std::optional<double> from, to;
    int count = 0;                    // of values in the range (grid, zip)
    bool logarithmic = false;
};
void visit(arcsim::Archive& a, SweepParameter& p);

struct SweepListPoint {
    std::vector<std::string> set;     // "key=value", as for --set
};
void visit(arcsim::Archive& a, SweepListPoint& p);

/// Which figures the chart of a sweep shows: columns of results.csv.
struct SweepChart {
    std::string x, y, series;
};
void visit(arcsim::Archive& a, SweepChart& c);

/// A sweep file.
struct SweepParams {
    arcsim::InputFile scene;
    SweepDesign design = SweepDesign::grid;
    std::vector<SweepParameter> parameters;
    std::vector<SweepListPoint> points;
    int samples = 0, seed = 1;
    int processes = 0;                // 0: one per core
    std::string from_stage, to_stage;
    std::vector<SweepChart> charts;
};
void visit(arcsim::Archive& a, SweepParams& p);

/// One run of a sweep: the overrides in the order in which they are given.
struct SweepPoint {
    int number = 0;
    std::vector<std::pair<std::string, std::string>> overrides;   // key, value as text for --set
};

/// All points of a sweep; the same file gives the same points on every machine.
/// @throws InputError: parameters of unequal length in a zip, an empty design, …
std::vector<SweepPoint> plan_points(const SweepParams& p);

}  // namespace formwork
