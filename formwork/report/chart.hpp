#pragma once

#include <string>
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

/// A chart with axes, round ticks, a grid and a legend.
Image line_chart(const std::vector<ChartSeries>& series, const std::string& title, const std::string& x_label,
                 const std::string& y_label);

}  // namespace formwork
