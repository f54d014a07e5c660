#include <iterator>
#include <nlohmann/json.hpp>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "arcsim/base/json_advice.hpp"
#include "arcsim/base/json_value.hpp"

namespace arcsim {

namespace {

constexpr int max_depth = 100;   // deeper input is an attack or an accident; recursion elsewhere relies on it

/// Hands the text to the parser one character at a time and counts, so that events know where they are.
struct CountingIterator {
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    const char* at = nullptr;
    std::size_t* count = nullptr;
    const char& operator*() const { return *at; }
    CountingIterator& operator++() {
        ++at;
        ++*count;
        return *this;
    }
    CountingIterator operator++(int) {
        CountingIterator old = *this;
        ++*this;
        return old;
    }
    bool operator==(const CountingIterator& o) const { return at == o.at; }
    bool operator!=(const CountingIterator& o) const { return at != o.at; }
};

/// Builds JsonValue from the parser's events.
class Builder {
public:
    using json = nlohmann::json;
    Builder(std::string_view text, const std::string& source, const std::size_t& count)
        : text_(text), source_(source), count_(count) {}

    bool null() { return scalar(JsonValue(), Ends::here); }
    bool boolean(bool v) { return scalar(JsonValue(v), Ends::here); }
    bool number_integer(json::number_integer_t v) { return integer(static_cast<double>(v)); }
    bool number_unsigned(json::number_unsigned_t v) { return integer(static_cast<double>(v)); }
    bool number_float(json::number_float_t v, const std::string&) { return scalar(JsonValue(v), Ends::one_before); }
    bool string(std::string& v) { return scalar(JsonValue(std::move(v)), Ends::here); }
    bool binary(json::binary_t&) { return false; }
    bool start_object(std::size_t) { return open(JsonValue::object()); }
    bool start_array(std::size_t) { return open(JsonValue::array()); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }
    bool key(std::string& name) {
        const auto [line, column] = locate(Ends::here);
        if (stack_.back().find(name)) fail(line, column, "the key \"" + name + "\" appears twice in one object. Keep one.");
        keys_.push_back(std::move(name));
        return true;
    }
    bool parse_error(std::size_t position, const std::string&, const json::exception& e) {
        line_ = 1, scanned_ = line_start_ = 0;
        const std::size_t at = std::min(position == 0 ? 0 : position - 1, text_.size());
        advance(at);
        const int column = static_cast<int>(at - line_start_) + 1;
        if (e.id == 406) fail(line_, column, "the number before this is too large for any computer. Mend it.");
        const std::string advice = json_advice(text_, position);
        if (!advice.empty()) fail(line_, column, "not valid JSON: " + advice);
        std::string what = e.what();   // "[json.exception.parse_error.101] parse error at line 3, column 5: ..."
        const std::size_t colon = what.find(": ");
        fail(line_, column, "not valid JSON: " + (colon == std::string::npos ? what : what.substr(colon + 2)) + ". Mend the text there.");
    }

    JsonValue root;

private:
    enum class Ends { here, one_before };   // a number is known to end only after one character more

    [[noreturn]] void fail(int line, int column, const std::string& what) const {
        throw InputError(source_ + ":" + std::to_string(line) + ":" + std::to_string(column) + ": " + what);
    }

    /// Line and column of the token that just ended: the first character after the last token that is not
    /// white space, comment or punctuation.
    std::pair<int, int> locate(Ends ends) {
        std::size_t i = end_;
        while (i < text_.size()) {
            const char c = text_[i];
            if (c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',' || c == ':' || c == '}' || c == ']') ++i;
            else if (c == '/' && i + 1 < text_.size() && text_[i + 1] == '/') i = std::min(text_.find('\n', i), text_.size());
            else if (c == '/' && i + 1 < text_.size() && text_[i + 1] == '*') {
                const std::size_t close = text_.find("*/", i + 2);
                i = close == std::string_view::npos ? text_.size() : close + 2;
            } else break;
        }
        advance(std::min(i, text_.size()));
        const std::pair<int, int> place{line_, static_cast<int>(scanned_ - line_start_) + 1};
        std::size_t end = std::min(count_, text_.size());
        if (ends == Ends::one_before && end < text_.size() && end > i) --end;
        end_ = std::max(end, i);
        return place;
    }
    void advance(std::size_t to) {
        for (; scanned_ < to; ++scanned_)
            if (text_[scanned_] == '\n') ++line_, line_start_ = scanned_ + 1;
    }

    bool integer(double v) {
        JsonValue value(v);
        value.is_integer = true;
        return scalar(std::move(value), Ends::one_before);
    }
    bool scalar(JsonValue v, Ends ends) {
        std::tie(v.line, v.column) = locate(ends);
        place(std::move(v));
        return true;
    }
    bool open(JsonValue v) {
        std::tie(v.line, v.column) = locate(Ends::here);
        if (stack_.size() >= max_depth) fail(v.line, v.column, "nested deeper than 100 levels. Flatten it.");
        stack_.push_back(std::move(v));
        return true;
    }
    bool close() {
        JsonValue v = std::move(stack_.back());
        stack_.pop_back();
        place(std::move(v));
        return true;
    }
    void place(JsonValue v) {
        if (stack_.empty()) {
            root = std::move(v);
        } else if (stack_.back().kind == JsonKind::array) {
            stack_.back().items.push_back(std::move(v));
        } else {
            stack_.back().members.emplace_back(std::move(keys_.back()), std::move(v));
            keys_.pop_back();
        }
    }

    std::string_view text_;
    const std::string& source_;
    const std::size_t& count_;      // characters that the parser has taken
    std::size_t end_ = 0;           // end of the last token
    std::size_t scanned_ = 0, line_start_ = 0;
    int line_ = 1;
    std::vector<JsonValue> stack_;
    std::vector<std::string> keys_;
};

}  // namespace

JsonDocument parse_json(std::string_view text, const std::string& source) {
    if (text.starts_with("version https://git-lfs"))
        throw InputError(source + ": is a Git LFS pointer, not the file itself. Run: git lfs pull");
    std::size_t count = 0;
    Builder builder(text, source, count);
    const CountingIterator first{text.data(), &count}, last{text.data() + text.size(), &count};
    nlohmann::json::sax_parse(first, last, &builder, nlohmann::json::input_format_t::json, true, true);
    return {source, std::filesystem::path(source).parent_path(), std::move(builder.root)};
}

JsonDocument read_json(const std::filesystem::path& file) {
    return parse_json(read_text_file(file), file.string());
}

}  // namespace arcsim
