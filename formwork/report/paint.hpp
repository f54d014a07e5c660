#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formwork/report/colour.hpp"

namespace formwork {

/// How numbers become colours, and what the legend says.
struct ColourScale {
    ColourMap map = ColourMap::sequential;
    double low = 0, high = 1;
    std::string title, unit;            // unit empty or "-": a plain number
    bool below = false, above = false;  // some values lie beyond the ends; the legend marks it
};

/// A scale from the 0.5 % to the 99.5 % quantile of the finite values, with rounded ends. A
/// diverging scale is symmetric about `centre`. A constant field gets a scale of small positive
/// width.
ColourScale sequential_scale(const std::vector<double>& values, std::string title,
                             std::string unit);
ColourScale diverging_scale(const std::vector<double>& values, std::string title, std::string unit,
                            double centre = 0);

/// Round numbers inside [low, high], about `target` of them.
std::vector<double> round_ticks(double low, double high, int target);
std::string tick_label(double value, double step);

struct Swatch {
    Rgb colour;
    std::string name;
};

/// The colours of a surface together with the legend that explains them.
struct Paint {
    std::vector<Rgb> colour;  // one per face, or per node when `per_node`; empty: plain
    bool per_node = false;
    std::optional<ColourScale> bar;
    std::string swatches_title;
    std::vector<Swatch> swatches;
    double dim = 0;  // 0..1: mixed towards white, so that lines stand out
};

Paint paint_plain();
Paint paint_values(const std::vector<double>& values, bool per_node, const ColourScale& scale);
/// @param class_of_face  index into `classes`
Paint paint_classes(const std::vector<int>& class_of_face, const std::vector<Swatch>& classes,
                    std::string title);

}  // namespace formwork
