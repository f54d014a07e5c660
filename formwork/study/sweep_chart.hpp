#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "formwork/study/sweep_table.hpp"

namespace formwork {

/// Draws the charts that a sweep file asks for into OUT/charts/, one PNG each, named by what they show. Points
/// that failed are drawn as dots off the curves; points without the figures are counted in the title.
/// @param results  the table of results.csv
/// @return one line for each chart that could not be drawn: a column that no point has, with the nearest name
std::vector<std::string> draw_sweep_charts(const SweepParams& params, const SweepTable& results,
                                           const std::filesystem::path& out);

}  // namespace formwork
