#include "arcsim/material/bending_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arcsim {

BendingTable::BendingTable(const BendingRows& rows, double multiplier) : rows_(rows) {
    for (auto& row : rows_)
        for (double& value : row) value *= multiplier;
}

bool BendingTable::is_zero() const {
    for (const auto& row : rows_)
        for (const double value : row)
            if (value != 0) return false;
    return true;
}

double BendingTable::direction(const Vector2d& e) {
    const double d = 4 * std::abs(std::atan2(e.y(), e.x())) / std::numbers::pi;
    return d > 2 ? 4 - d : d;
}

BendingTable::Sample BendingTable::sample(double direction, double c) const {
    const double b = std::min(0.1 * c, 4.0);
    const int column = static_cast<int>(std::min(std::max(0.0, std::floor(b)), 3.0));   // 0 for NaN, which the answer then is
    const double fb = b - column;
    const int row = std::clamp(static_cast<int>(direction), 0, 1);
    const double fd = direction - row;
    const auto mix = [&](int j) { return (1 - fd) * rows_[row][j] + fd * rows_[row + 1][j]; };
    const double low = mix(column), high = mix(column + 1);
    const double k = (1 - fb) * low + fb * high;
    if (k <= 0) return {0, 0};
    return {k, 0.1 * c < 4 ? 0.1 * (high - low) : 0};
}

}  // namespace arcsim
