#pragma once

#include <filesystem>

#include "arcsim/base/json_value.hpp"
#include "formwork/study/fit.hpp"
#include "formwork/study/tensile.hpp"

namespace formwork {

/// DIR/tensile/tensile.csv and tensile.png. @returns the object of summary.json
arcsim::JsonValue write_tensile(const std::filesystem::path& dir, const std::vector<TensileCurve>& curves, bool with_measured);

/// DIR/fit/fit.csv, points.csv, fit.png and, for tensors, material.json. @returns the object of summary.json
arcsim::JsonValue write_fit(const std::filesystem::path& dir, const FitResult& result, double density);

}  // namespace formwork
