#pragma once

#include <string>
#include <string_view>

namespace arcsim {

/// What a person most likely did where JSON stops making sense, and how to mend it: one sentence, or empty.
/// @param end  characters of `text` that were read when the parser gave up
std::string json_advice(std::string_view text, std::size_t end);

}  // namespace arcsim
