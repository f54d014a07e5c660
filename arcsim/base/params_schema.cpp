#include "arcsim/base/params_schema.hpp"

#include <cmath>

namespace arcsim {

namespace {

JsonValue object_schema() {
    JsonValue s = JsonValue::object();
    s.set("type", "object");
    s.set("properties", JsonValue::object());
    s.set("additionalProperties", false);
    return s;
}

JsonValue number_schema(const char* type, const Range& r) {
    JsonValue s = JsonValue::object();
    s.set("type", type);
    if (std::isfinite(r.min)) s.set(r.open_min ? "exclusiveMinimum" : "minimum", r.min);
    if (std::isfinite(r.max)) s.set(r.open_max ? "exclusiveMaximum" : "maximum", r.max);
    return s;
}

JsonValue type_schema(const char* type) {
    JsonValue s = JsonValue::object();
    s.set("type", type);
    return s;
}

JsonValue array_schema(JsonValue items) {
    JsonValue s = type_schema("array");
    s.set("items", std::move(items));
    return s;
}

template <class T>
JsonValue array_of(const std::vector<T>& v) {
    JsonValue a = JsonValue::array();
    for (const T& item : v) a.add(JsonValue(item));
    return a;
}

}  // namespace

ParamsSchema::ParamsSchema() { levels_.push_back({object_schema()}); }

void ParamsSchema::add(const Field& f, JsonValue schema, JsonValue default_value) {
    if (given_ != Given::plain) {
        JsonValue types = JsonValue::array();
        if (const JsonValue* type = schema.find("type")) {
            types.add(*type);
            types.add("null");
            schema.set("type", std::move(types));
        }
    }
    std::string text = f.doc;
    if (*f.unit) text += (text.empty() ? "Unit: " : " Unit: ") + std::string(f.unit) + ".";
    if (!text.empty()) schema.set("description", text);
    const bool infinite = default_value.kind == JsonKind::number && !std::isfinite(default_value.number);
    if (given_ == Given::nullable_without_default) schema.set("default", JsonValue());
    else if (!f.is_required && !infinite && default_value.kind != JsonKind::absent) schema.set("default", std::move(default_value));
    JsonValue& object = levels_.back().schema;
    object.find("properties")->set(f.key, std::move(schema));
    if (f.is_required && when_depth_ == 0) {
        if (!object.find("required")) object.set("required", JsonValue::array());
        object.find("required")->add(f.key);
    }
}

void ParamsSchema::raw(const char* key, JsonValue&, const char* doc) {
    JsonValue none;
    none.kind = JsonKind::absent;
    add({key, "", doc, any_number, false}, JsonValue::object(), none);
}

void ParamsSchema::value(const Field& f, bool& v) { add(f, type_schema("boolean"), v); }
void ParamsSchema::value(const Field& f, int& v) { add(f, number_schema("integer", f.range), v); }
void ParamsSchema::value(const Field& f, double& v) { add(f, number_schema("number", f.range), v); }
void ParamsSchema::value(const Field& f, std::string& v) { add(f, type_schema("string"), v); }
void ParamsSchema::value(const Field& f, InputFile& v) {
    JsonValue none;
    none.kind = JsonKind::absent;
    add(f, type_schema("string"), v.name.empty() ? none : JsonValue(v.name));
}
void ParamsSchema::value(const Field& f, std::vector<double>& v) {
    add(f, array_schema(number_schema("number", f.range)), array_of(v));
}
void ParamsSchema::value(const Field& f, std::vector<int>& v) {
    add(f, array_schema(number_schema("integer", f.range)), array_of(v));
}
void ParamsSchema::value(const Field& f, std::vector<std::string>& v) {
    add(f, array_schema(type_schema("string")), array_of(v));
}
void ParamsSchema::fixed_array(const Field& f, double* v, int n) {
    JsonValue s = array_schema(number_schema("number", f.range));
    s.set("minItems", n);
    s.set("maxItems", n);
    add(f, std::move(s), array_of(std::vector<double>(v, v + n)));
}

void ParamsSchema::name_or_index_field(const Field& f, std::string&) {
    JsonValue s = JsonValue::object(), types = JsonValue::array();
    types.add("string");
    types.add("integer");
    if (given_ != Given::plain) types.add("null");
    s.set("type", std::move(types));
    if (*f.doc) s.set("description", f.doc);
    levels_.back().schema.find("properties")->set(f.key, std::move(s));
}

void ParamsSchema::choice_field(const Field& f, int& index, const std::vector<Choice>& choices) {
    JsonValue s = JsonValue::object(), names = JsonValue::array();
    std::string text = f.doc;
    for (const Choice& c : choices) {
        names.add(c.name);
        if (*c.doc) text += std::string(text.empty() ? "" : " ") + "\"" + c.name + "\": " + c.doc + ".";
    }
    s.set("enum", std::move(names));
    JsonValue none;
    none.kind = JsonKind::absent;
    add({f.key, f.unit, text.c_str(), f.range, f.is_required}, std::move(s), index >= 0 ? JsonValue(choices[index].name) : none);
}

void ParamsSchema::direction(const char* key, Vector3d& v, const char* doc) {
    JsonValue names = JsonValue::object(), list = JsonValue::array();
    for (const char* name : {"x", "y", "z", "-x", "-y", "-z"}) list.add(name);
    names.set("enum", std::move(list));
    JsonValue numbers = array_schema(type_schema("number"));
    numbers.set("minItems", 3);
    numbers.set("maxItems", 3);
    JsonValue s = JsonValue::object(), any = JsonValue::array();
    any.add(std::move(names));
    any.add(std::move(numbers));
    s.set("anyOf", std::move(any));
    add({key, "", doc, any_number, false}, std::move(s), array_of(std::vector<double>(v.data(), v.data() + 3)));
}

void ParamsSchema::exactly_one_of(std::initializer_list<const char*> keys) {
    // "given" means present and not null, so each branch asks for a non-null value and forbids the others'.
    JsonValue branches = JsonValue::array();
    for (const char* key : keys) {
        JsonValue branch = JsonValue::object(), needed = JsonValue::array(), properties = JsonValue::object();
        needed.add(key);
        JsonValue not_null = JsonValue::object();
        not_null.set("not", type_schema("null"));
        properties.set(key, std::move(not_null));
        branch.set("required", std::move(needed));
        branch.set("properties", std::move(properties));
        branches.add(std::move(branch));
    }
    levels_.back().schema.set("oneOf", std::move(branches));
}

void ParamsSchema::ignored(const char* key, const char* why) {
    JsonValue s = JsonValue::object();
    s.set("description", std::string("Accepted and ignored: ") + why);
    levels_.back().schema.find("properties")->set(key, std::move(s));
}

void ParamsSchema::unsupported(const char* key, const std::string& remedy) {
    JsonValue s = JsonValue::object();
    s.set("description", "Not supported. " + remedy);
    levels_.back().schema.find("properties")->set(key, std::move(s));
}

bool ParamsSchema::begin_optional(const Field&, bool has_value) {
    given_ = has_value ? Given::nullable : Given::nullable_without_default;
    return true;
}
bool ParamsSchema::end_optional() {
    const bool was_missing = given_ == Given::nullable_without_default;
    given_ = Given::plain;
    return was_missing;
}

bool ParamsSchema::enter(const Field& f, Presence presence) {
    JsonValue s = object_schema();
    if (*f.doc) s.set("description", f.doc);
    levels_.push_back({std::move(s), presence != Presence::always});
    keys_.emplace_back(f.key);
    return true;
}

int ParamsSchema::begin_list(const Field& f, int) {
    JsonValue s = type_schema("array");
    if (*f.doc) s.set("description", f.doc);
    levels_.back().schema.find("properties")->set(f.key, std::move(s));
    keys_.emplace_back(f.key);
    return 1;
}

void ParamsSchema::enter_item(int) {
    levels_.push_back({object_schema()});
    keys_.emplace_back();   // an item: leave() puts it into the list's key
}

void ParamsSchema::leave() {
    Level done = std::move(levels_.back());
    levels_.pop_back();
    if (done.nullable) {
        JsonValue types = JsonValue::array();
        types.add("object");
        types.add("null");
        done.schema.set("type", std::move(types));
    }
    const std::string key = std::move(keys_.back());
    keys_.pop_back();
    JsonValue* properties = levels_.back().schema.find("properties");
    if (!key.empty()) {
        properties->set(key, std::move(done.schema));
        return;
    }
    properties->find(keys_.back())->set("items", std::move(done.schema));
    keys_.pop_back();   // a list is described by one item
}

bool ParamsSchema::begin_when(bool) {
    ++when_depth_;
    return true;
}

}  // namespace arcsim
