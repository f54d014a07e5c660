#pragma once

#include <numbers>

namespace formwork {

inline constexpr double degree = std::numbers::pi / 180;   // rad

}  // namespace formwork
