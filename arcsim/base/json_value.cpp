#include "arcsim/base/json_value.hpp"

#include <charconv>
#include <cmath>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"

namespace arcsim {

const JsonValue* JsonValue::find(std::string_view key) const {
    for (const auto& [name, value] : members)
        if (name == key) return &value;
    return nullptr;
}

JsonValue* JsonValue::find(std::string_view key) {
    return const_cast<JsonValue*>(static_cast<const JsonValue*>(this)->find(key));
}

JsonValue& JsonValue::set(std::string_view key, JsonValue v) {
    kind = JsonKind::object;
    if (JsonValue* member = find(key)) return *member = std::move(v);
    members.emplace_back(std::string(key), std::move(v));
    return members.back().second;
}

JsonValue& JsonValue::add(JsonValue v) {
    kind = JsonKind::array;
    items.push_back(std::move(v));
    return items.back();
}

namespace {

std::string json_string(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        switch (c) {
            case '"': out += "\\\""; break;
            case '\\': out += "\\\\"; break;
            case '\n': out += "\\n"; break;
            case '\r': out += "\\r"; break;
            case '\t': out += "\\t"; break;
            default:
                if (static_cast<unsigned char>(c) < 0x20) {
                    constexpr char hex[] = "0123456789abcdef";
                    out += std::string("\\u00") + hex[(c >> 4) & 15] + hex[c & 15];
                } else {
                    out += c;
                }
        }
    }
    return out + '"';
}

bool holds_object(const JsonValue& v) {
    for (const JsonValue& item : v.items)
        if (item.kind == JsonKind::object || holds_object(item)) return true;
    return false;
}

void write_one_line(const JsonValue& v, std::string& out) {
    switch (v.kind) {
        case JsonKind::absent:
        case JsonKind::null: out += "null"; break;
        case JsonKind::boolean: out += v.boolean ? "true" : "false"; break;
        case JsonKind::number: out += std::isfinite(v.number) ? format_number(v.number) : "null"; break;
        case JsonKind::string: out += json_string(v.string); break;
        case JsonKind::array:
            out += '[';
            for (std::size_t i = 0; i < v.items.size(); ++i) {
                if (i > 0) out += ", ";
                write_one_line(v.items[i], out);
            }
            out += ']';
            break;
        case JsonKind::object:
            out += '{';
            for (std::size_t i = 0; i < v.members.size(); ++i) {
                if (i > 0) out += ", ";
                out += json_string(v.members[i].first) + ": ";
                write_one_line(v.members[i].second, out);
            }
            out += '}';
            break;
    }
}

constexpr std::size_t line_width = 110;

void write_pretty(const JsonValue& v, int depth, std::string& out) {
    const bool container = v.kind == JsonKind::array || v.kind == JsonKind::object;
    if (!container || (v.kind == JsonKind::array ? v.items.empty() : v.members.empty()))
        return write_one_line(v, out);
    if (v.kind == JsonKind::array && !holds_object(v)) {
        std::string line;
        write_one_line(v, line);
        if (line.size() <= line_width) {
            out += line;
            return;
        }
    }
    const std::string inner(2 * (depth + 1), ' ');
    const bool object = v.kind == JsonKind::object;
    const std::size_t n = object ? v.members.size() : v.items.size();
    out += object ? "{\n" : "[\n";
    for (std::size_t i = 0; i < n; ++i) {
        out += inner;
        if (object) out += json_string(v.members[i].first) + ": ";
        write_pretty(object ? v.members[i].second : v.items[i], depth + 1, out);
        out += i + 1 < n ? ",\n" : "\n";
    }
    out += std::string(2 * depth, ' ') + (object ? "}" : "]");
}

}  // namespace

std::string to_text(const JsonValue& v) {
    std::string out;
    write_pretty(v, 0, out);
    return out + "\n";
}

std::string to_text_one_line(const JsonValue& v) {
    std::string out;
    write_one_line(v, out);
    return out;
}

void override_value(JsonValue& root, const std::vector<std::string>& path, const std::string& text,
                    const std::string& origin) {
    JsonValue* at = &root;
    for (const std::string& name : path) {
        if (at->kind == JsonKind::array) {
            long index = -1;
            if (!parse_integer(name, index) || index < 0 || index >= static_cast<long>(at->items.size()))
                throw InputError(origin + ": \"" + name + "\" is not a position in an array of " +
                                 std::to_string(at->items.size()) + " items. Count from 0.");
            at = &at->items[index];
            continue;
        }
        if (at->kind == JsonKind::null) *at = JsonValue::object();
        if (at->kind != JsonKind::object)
            throw InputError(origin + ": \"" + name + "\" lies below a value that is not an object.");
        JsonValue* next = at->find(name);
        at = next ? next : &at->set(name, JsonValue());
    }
    try {
        *at = parse_json(text, origin).root;
    } catch (const InputError&) {
        *at = JsonValue(text);   // --set a.b=name: a bare word is a string
    }
    at->line = at->column = 0;
    at->origin = origin;
}

}  // namespace arcsim
