#pragma once

#include <string>
#include <utility>
#include <vector>

#include "formwork/report/image.hpp"

namespace formwork {

/// One series of a line chart, drawn as a line, as dots, or both.
struct ChartSeries {
    std::string name;
    std::vector<double> x, y;
    bool line = true, dots = false;
    int colour = 0;      // class_colour
};

enum class AxisScale { from_zero, fitted, logarithmic };   // fitted: as far as the values reach

struct ChartAxis {
    ChartAxis(const char* axis_label) : label(axis_label) {}
    ChartAxis(std::string axis_label, AxisScale axis_scale) : label(std::move(axis_label)), scale(axis_scale) {}
    std::string label;
    AxisScale scale = AxisScale::from_zero;
};

/// A chart with axes, round ticks, a grid and a legend. A logarithmic axis asks for values above zero.
Image line_chart(const std::vector<ChartSeries>& series, const std::string& title, const ChartAxis& x, const ChartAxis& y);

}  // namespace formwork
