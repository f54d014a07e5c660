#pragma once

#include <set>
#include <string>
#include <vector>

#include "arcsim/base/archive.hpp"
#include "arcsim/base/error.hpp"
#include "arcsim/base/json_value.hpp"

namespace arcsim {

/// Warnings of a reader, in order; the program prints them.
using Warnings = std::vector<std::string>;

/// A place in a document: for formats that no `visit` describes (ArcSim's arrays of rows, say). Getters
/// check the type and throw InputError with file:line:column and JSON pointer.
class JsonNode {
public:
    JsonNode(const JsonDocument& document) : JsonNode(document, document.root, "") {}
    JsonNode(const JsonDocument& document, const JsonValue& value, std::string pointer)
        : document_(&document), value_(&value), pointer_(std::move(pointer)) {}

    JsonKind kind() const { return value_->kind; }
    const std::string& pointer() const { return pointer_; }   // "" at the root
    const JsonDocument& document() const { return *document_; }
    const JsonValue& value() const { return *value_; }

    bool boolean() const;
    double number(const Range& range = any_number, const char* unit = "", const char* doc = "") const;
    int integer(const Range& range = any_number, const char* doc = "") const;
    const std::string& string() const;
    InputFile file() const;            // a string naming a file that exists

    int size() const;                  // of an array; an error for anything else
    JsonNode operator[](int i) const;  // item of an array
    JsonNode at(const char* key) const;   // member of an object; an error when it is missing
    bool has(const char* key) const;      // false also for null

    /// "file:line:column: /pointer: " and then what. Never returns.
    [[noreturn]] void fail(const std::string& what) const;
    std::string place() const;         // "file:line:column: /pointer: "
    std::string shown() const;         // what stands here, short, for messages

private:
    const JsonDocument* document_;
    const JsonValue* value_;
    std::string pointer_;
};

/// A key that the object does not have. `guessed`: the message already suggests one beside it.
struct UnknownKeyError : InputError {
    UnknownKeyError(const std::string& what, std::string k, bool g) : InputError(what), key(std::move(k)), guessed(g) {}
    std::string key;
    bool guessed;
};

/// What a reader does with keys that other programs know and this one does not act on.
enum class Unsupported { error, warn };

/// Fills structs from a JSON object through their `visit`. Use read_params.
class ParamsReader final : public Archive {
public:
    ParamsReader(const JsonNode& node, Warnings& warnings, Unsupported unsupported);
    void finish();   // unknown keys of the outermost object; @throws InputError

    void direction(const char* key, Vector3d& v, const char* doc) override;
    void raw(const char* key, JsonValue& v, const char* doc) override;
    void exactly_one_of(std::initializer_list<const char*> keys) override;
    void check(bool ok, const char* key, const std::string& remedy) override;
    void ignored(const char* key, const char* why) override;
    void unsupported(const char* key, const std::string& remedy) override;
    JsonKind kind(const char* key) const override;

private:
    struct Level {
        JsonNode node;                      // an object
        std::vector<std::string> known;     // keys that visit asked for
    };

    void value(const Field&, bool&) override;
    void value(const Field&, int&) override;
    void value(const Field&, double&) override;
    void value(const Field&, std::string&) override;
    void value(const Field&, InputFile&) override;
    void value(const Field&, std::vector<double>&) override;
    void value(const Field&, std::vector<int>&) override;
    void value(const Field&, std::vector<std::string>&) override;
    void fixed_array(const Field&, double* v, int n) override;
    void name_or_index_field(const Field& f, std::string& v) override;
    void choice_field(const Field&, int& index, const std::vector<Choice>& choices) override;
    bool begin_optional(const Field&, bool has_value) override;
    bool end_optional() override { return false; }
    bool enter(const Field&, Presence) override;
    int begin_list(const Field&, int size) override;
    void enter_item(int index) override;
    void end_list() override { lists_.pop_back(); }
    void leave() override;
    bool begin_when(bool condition) override { return condition; }
    void end_when() override {}

    std::optional<JsonNode> get(const Field& f);   // nothing: absent and optional
    void push(const JsonNode& node);

    std::vector<Level> levels_;
    std::vector<JsonNode> lists_;
    Warnings& warnings_;
    Unsupported unsupported_;
};

/// Reads one struct from an object. @throws InputError: missing, unknown or repeated keys, wrong types, ranges
template <class P>
void read_params(const JsonNode& node, P& p, Warnings& warnings, Unsupported unsupported = Unsupported::error) {
    ParamsReader reader(node, warnings, unsupported);
    visit(static_cast<Archive&>(reader), p);
    reader.finish();
}

}  // namespace arcsim
