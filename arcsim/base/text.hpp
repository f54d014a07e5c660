#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace arcsim {

/// Shortest decimal text that reads back to the same double; "0" for both zeros.
std::string format_number(double v);
/// `digits` significant digits, without trailing zeros: for messages and tables.
std::string format_short(double v, int digits = 4);

/// The candidate nearest to `word` by edits (transpositions count one), if it is near enough to be a slip.
/// Empty: none.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");

/// Parses the whole of `text` as a finite or non-finite double; false when anything is left over.
bool parse_number(std::string_view text, double& value);
bool parse_integer(std::string_view text, long& value);

}  // namespace arcsim
