#include "arcsim/base/json_advice.hpp"

#include <algorithm>
#include <cctype>

namespace arcsim {

namespace {

struct Token {
    char first = 0;        // its first character; 0: none
    bool is_value = false; // text, number, bare word
};

/// The last token that begins before `end`, the one before it, and how many brackets are open.
struct Scan {
    Token last, before;
    int open = 0;
};

Scan scan(std::string_view text, std::size_t end) {
    Scan s;
    const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '+' || c == '.' || c == '_'; };
    for (std::size_t i = text.starts_with("\xEF\xBB\xBF") ? 3 : 0; i < std::min(end, text.size());) {
        const char c = text[i];
        if (std::isspace(static_cast<unsigned char>(c))) {
            ++i;
        } else if (text.substr(i, 2) == "//") {
            i = std::min(text.find('\n', i), text.size());
        } else if (text.substr(i, 2) == "/*") {
            i = std::min(text.find("*/", i), text.size() - 2) + 2;
        } else {
            s.before = s.last;
            s.last = {c, c == '"' || is_word(c)};
            s.open += (c == '{' || c == '[') - (c == '}' || c == ']');
            ++i;
            if (c == '"') {
                while (i < text.size() && text[i] != '"') i += text[i] == '\\' ? 2 : 1;
                ++i;
            } else if (is_word(c)) {
                while (i < text.size() && is_word(text[i])) ++i;
            }
        }
    }
    return s;
}

}  // namespace

std::string json_advice(std::string_view text, std::size_t end) {
    if (text.substr(0, 4).find('\0') != std::string_view::npos || text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
        return "the file is no UTF-8 text. Save it as UTF-8.";
    const Scan s = scan(text, end);
    const bool at_end = end > text.size() || s.last.first == 0;
    if (s.last.first == 0 && scan(text, text.size()).last.first == 0) return "the file is empty.";
    if (at_end && s.open > 0) return "the text ends while " + std::to_string(s.open) + (s.open == 1 ? " bracket is" : " brackets are") + " still open.";
    const char c = s.last.first;
    if (c == '\'') return "names and texts stand in double quotes: \"x\".";
    if ((c == '}' || c == ']') && s.before.first == ',') return std::string("remove the comma before this ") + c + ".";
    const bool starts = s.last.is_value || c == '{' || c == '[';
    if (starts && (s.before.is_value || s.before.first == '}' || s.before.first == ']')) return "a comma or colon is missing before this.";
    if (std::isalpha(static_cast<unsigned char>(c))) return "names and texts stand in double quotes; only true, false and null do not.";
    return "";
}

}  // namespace arcsim
