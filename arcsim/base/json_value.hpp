#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "arcsim/base/archive.hpp"

namespace arcsim {

/// One JSON value with the place it was read from. Members keep the order of the file.
struct JsonValue {
    JsonKind kind = JsonKind::null;
    bool boolean = false;
    double number = 0;
    bool is_integer = false;      // written without fraction or exponent
    std::string string;
    std::vector<JsonValue> items;                              // of an array
    std::vector<std::pair<std::string, JsonValue>> members;    // of an object
    int line = 0, column = 0;     // 1-based; 0: not from the file
    std::string origin;           // where it came from when not from the file, e.g. "--set a.b=1"

    JsonValue() = default;
    JsonValue(bool v) : kind(JsonKind::boolean), boolean(v) {}
    JsonValue(double v) : kind(JsonKind::number), number(v) {}
    JsonValue(int v) : kind(JsonKind::number), number(v), is_integer(true) {}
    JsonValue(std::string v) : kind(JsonKind::string), string(std::move(v)) {}
    JsonValue(const char* v) : JsonValue(std::string(v)) {}
    static JsonValue array() { return of_kind(JsonKind::array); }
    static JsonValue object() { return of_kind(JsonKind::object); }

    const JsonValue* find(std::string_view key) const;   // member of an object; nullptr: none
    JsonValue* find(std::string_view key);
    JsonValue& set(std::string_view key, JsonValue v);   // replaces or appends; returns the member
    JsonValue& add(JsonValue v);                         // appends to an array; returns the item

private:
    static JsonValue of_kind(JsonKind k) {
        JsonValue v;
        v.kind = k;
        return v;
    }
};

/// A parsed file: its name for messages, and its folder, beside which it looks for other files.
struct JsonDocument {
    std::string source;             // as the user named it
    std::filesystem::path folder;
    JsonValue root;
};

/// Parses JSON with // and /* */ comments.
/// @throws InputError with file:line:column: malformed text, duplicate key, nesting beyond 100 levels
JsonDocument parse_json(std::string_view text, const std::string& source);
/// @throws InputError also when the file cannot be read
JsonDocument read_json(const std::filesystem::path& file);

/// Text that reads back to the same value: shortest round-trip numbers, members in order. Arrays without
/// objects in them stay on one line up to 110 characters. Non-finite numbers become null.
std::string to_text(const JsonValue& v);
std::string to_text_one_line(const JsonValue& v);

/// Puts `text` (JSON, or else taken as a string) at a path of member names or array positions, making
/// objects on the way. The value remembers `origin` for messages.
/// @throws InputError naming origin: a path through something that is not an object or array
void override_value(JsonValue& root, const std::vector<std::string>& path, const std::string& text,
                    const std::string& origin);

}  // namespace arcsim
