#pragma once

#include <filesystem>

#include "arcsim/base/json_value.hpp"

namespace formwork {

/// OUT/summary.json: one object per finished stage.
arcsim::JsonValue read_summary(const std::filesystem::path& dir);   // an empty object when there is none
void write_summary(const std::filesystem::path& dir, const arcsim::JsonValue& summary);

/// 64-bit FNV-1a, as 16 hexadecimal digits: tells whether inputs are the same, not more.
std::string fingerprint(std::string_view bytes);

}  // namespace formwork
