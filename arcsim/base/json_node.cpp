#include <cmath>

#include "arcsim/base/error.hpp"
#include "arcsim/base/json_reader.hpp"
#include "arcsim/base/text.hpp"

namespace arcsim {

std::string Range::words(std::string_view noun) const {
    const bool low = std::isfinite(min), high = std::isfinite(max);
    std::string text(noun);
    if (low && high && !open_min && !open_max) return text + " from " + format_number(min) + " to " + format_number(max);
    if (low) text += (open_min ? " > " : " >= ") + format_number(min);
    if (low && high) text += " and";
    if (high) text += (open_max ? " < " : " <= ") + format_number(max);
    return text;
}

std::string JsonNode::place() const {
    std::string text = value_->origin.empty() ? document_->source : value_->origin;
    if (value_->line > 0) text += ":" + std::to_string(value_->line) + ":" + std::to_string(value_->column);
    return text + ": " + (pointer_.empty() ? "/" : pointer_) + ": ";
}

void JsonNode::fail(const std::string& what) const { throw InputError(place() + what); }

std::string JsonNode::shown() const {
    switch (value_->kind) {
        case JsonKind::object: return "an object";
        case JsonKind::array: return "an array of " + std::to_string(value_->items.size());
        default: break;
    }
    std::string text = to_text_one_line(*value_);
    constexpr std::size_t longest = 60;
    if (text.size() > longest) text = text.substr(0, longest) + "…";
    return text;
}

bool JsonNode::boolean() const {
    if (kind() != JsonKind::boolean) fail("expected true or false, got " + shown() + ".");
    return value_->boolean;
}

namespace {

std::string in_unit(const char* unit) { return *unit ? std::string(" (") + unit + ")" : ""; }
std::string remedy(const char* doc) { return *doc ? std::string(" ") + doc : ""; }

}  // namespace

double JsonNode::number(const Range& range, const char* unit, const char* doc) const {
    if (kind() != JsonKind::number || !std::isfinite(value_->number) || !range.contains(value_->number))
        fail("expected " + range.words("a number") + in_unit(unit) + ", got " + shown() + "." + remedy(doc));
    return value_->number;
}

int JsonNode::integer(const Range& range, const char* doc) const {
    const double v = value_->number;
    if (kind() != JsonKind::number || v != std::floor(v) || std::abs(v) > 2147483647.0 || !range.contains(v))
        fail("expected " + range.words("an integer") + ", got " + shown() + "." + remedy(doc));
    return static_cast<int>(v);
}

const std::string& JsonNode::string() const {
    if (kind() != JsonKind::string) fail("expected a string, got " + shown() + ".");
    return value_->string;
}

InputFile JsonNode::file() const {
    namespace fs = std::filesystem;
    InputFile f{string(), {}};
    if (f.name.empty()) fail("expected a file name, got an empty string.");
    const fs::path beside = document_->folder / f.name;   // an absolute name stays itself
    std::error_code ignored;
    for (const fs::path& candidate : {beside, fs::path(f.name)})
        if (fs::is_regular_file(candidate, ignored)) {
            f.path = candidate.lexically_normal();
            return f;
        }
    if (fs::is_directory(beside, ignored)) fail("\"" + f.name + "\" is a folder, not a file. Name a file in it.");
    fail("no file \"" + f.name + "\": looked for " + beside.lexically_normal().string() +
         (beside == fs::path(f.name) ? "" : " and, in the working directory, " + f.name) + ". Check the name.");
}

int JsonNode::size() const {
    if (kind() != JsonKind::array) fail("expected an array [ ... ], got " + shown() + ".");
    return static_cast<int>(value_->items.size());
}

JsonNode JsonNode::operator[](int i) const {
    return {*document_, value_->items.at(i), pointer_ + "/" + std::to_string(i)};
}

bool JsonNode::has(const char* key) const {
    const JsonValue* v = value_->find(key);
    return v && v->kind != JsonKind::null;
}

JsonNode JsonNode::at(const char* key) const {
    if (kind() != JsonKind::object) fail("expected an object, got " + shown() + ".");
    const JsonValue* v = value_->find(key);
    if (!v) fail(std::string("the key \"") + key + "\" is missing.");
    return {*document_, *v, pointer_ + "/" + key};
}

}  // namespace arcsim
