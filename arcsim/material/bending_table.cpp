#include "arcsim/material/bending_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arcsim {

BendingTable::BendingTable(const BendingRows& rows, double multiplier) : rows_(rows) {
    for (auto& row : rows_)
        for (double& value : row) value *= multiplier;
}

double BendingTable::direction(const Vector2d& e) {
    const double d = 4 * std::abs(std::atan2(e.y(), e.x())) / std::numbers::pi;
    return d > 2 ? 4 - d : d;
}

double BendingTable::k(double direction, double c) const {
    const double b = std::min(0.1 * c, 4.0);
    const int column = std::clamp(static_cast<int>(std::floor(b)), 0, 3);
    const double fb = b - column;
    const int row = std::clamp(static_cast<int>(direction), 0, 1);
    const double fd = direction - row;
    const auto along = [&](int r) { return (1 - fb) * rows_[r][column] + fb * rows_[r][column + 1]; };
    return std::max((1 - fd) * along(row) + fd * along(row + 1), 0.0);
}

}  // namespace arcsim
