#include "formwork/scene/scene_reference.hpp"

#include <map>

#include "arcsim/base/params_schema.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/scene/formwork_scene.hpp"

namespace formwork {

using arcsim::format_number;
using arcsim::JsonKind;
using arcsim::JsonValue;

namespace {

const std::string& text_of(const JsonValue& schema, const char* key) {
    static const std::string none;
    const JsonValue* v = schema.find(key);
    return v ? v->string : none;
}

/// "number", of a type that may also be null.
std::string type_name(const JsonValue& schema) {
    const JsonValue* type = schema.find("type");
    if (!type) return "";
    if (type->kind == JsonKind::string) return type->string;
    std::vector<std::string> names;
    for (const JsonValue& t : type->items)
        if (t.string != "null") names.push_back(t.string);
    return arcsim::join(names, " or ");
}

std::string bounds(const JsonValue& schema) {
    std::string text;
    const auto add = [&](const char* key, const char* sign) {
        if (const JsonValue* v = schema.find(key)) text += (text.empty() ? " " : ", ") + std::string(sign) + " " + format_number(v->number);
    };
    add("minimum", "≥");
    add("exclusiveMinimum", ">");
    add("maximum", "≤");
    add("exclusiveMaximum", "<");
    return text;
}

std::string choices(const JsonValue& names) {
    std::vector<std::string> words;
    for (const JsonValue& n : names.items)
        if (n.kind == JsonKind::string) words.push_back("`\"" + n.string + "\"`");
    return arcsim::join(words, " ");
}

/// What may stand at a key, in words.
std::string allowed(const JsonValue& schema) {
    if (const JsonValue* names = schema.find("enum")) return choices(*names);
    if (const JsonValue* any = schema.find("anyOf")) {
        std::vector<std::string> words;
        for (const JsonValue& one : any->items) words.push_back(allowed(one));
        return arcsim::join(words, " or ");
    }
    const std::string type = type_name(schema);
    const JsonValue* items = schema.find("items");
    if (type != "array" || !items) return type + bounds(schema);
    const JsonValue* count = schema.find("minItems");
    return (count ? format_number(count->number) + " " : "list of ") + type_name(*items) + "s" + bounds(*items);
}

/// Markdown anchors of GitHub and others: lower case, without punctuation.
std::string link_to(const std::string& path) {
    std::string anchor;
    for (const char c : path)
        if (c != '.' && c != '[' && c != ']') anchor += c;
    return "[`" + path + "`](#" + anchor + ")";
}

std::string in_table(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
    return text;
}

class Reference {
public:
    /// One section for an object, then those of the objects in it. `skip`: a member that has its own section before.
    void section(const std::string& path, const JsonValue& schema, const std::string& skip = "") {
        std::string rows;
        std::vector<std::pair<std::string, const JsonValue*>> inner;
        const JsonValue* required = schema.find("required");
        for (const auto& [key, value] : schema.find("properties")->members) {
            if (key == skip) continue;
            const std::string below = path.empty() ? key : path + "." + key;
            const JsonValue* items = value.find("items");
            const bool of_objects = items && items->find("properties");
            const JsonValue* object = of_objects ? items : value.find("properties") ? &value : nullptr;
            std::string what = object ? (of_objects ? "list of objects" : "object") : allowed(value);
            if (object) {
                const std::string name = below + (of_objects ? "[]" : "");
                const auto [seen, fresh] = sections_.try_emplace(to_text(*object->find("properties")), name);
                what += ": " + link_to(seen->second);
                if (fresh) inner.push_back({name, object});
            }
            bool needed = false;
            if (required)
                for (const JsonValue& r : required->items) needed = needed || r.string == key;
            const JsonValue* d = value.find("default");
            const std::string otherwise = needed ? "**required**" : d && d->kind != JsonKind::null ? "`" + arcsim::to_text_one_line(*d) + "`" : "";
            rows += "| `" + key + "` | " + in_table(what) + " | " + in_table(otherwise) + " | " + in_table(text_of(value, "description")) + " |\n";
        }
        const std::string& what_it_is = text_of(schema, "description");
        out += path.empty() ? "\n## The whole file\n\nAn ArcSim scene.\n" : "\n### " + path + "\n" + (what_it_is.empty() ? "" : "\n" + what_it_is + "\n");
        if (const JsonValue* one_of = schema.find("oneOf")) {
            std::vector<std::string> keys;
            for (const JsonValue& branch : one_of->items) keys.push_back("`" + branch.find("required")->items.front().string + "`");
            out += "\nExactly one of " + arcsim::join(keys) + ".\n";
        }
        out += "\n| key | what | default | meaning |\n|---|---|---|---|\n" + rows;
        for (const auto& [name, object] : inner) section(name, *object);
    }

    std::string out;

private:
    static std::string to_text(const JsonValue& v) { return arcsim::to_text_one_line(v); }
    std::map<std::string, std::string> sections_;   // keys of an object -> where they are listed
};

}  // namespace

std::string scene_reference_text() {
    const JsonValue schema = arcsim::schema_of<FormworkScene>();
    Reference reference;
    reference.out =
        "# Scene files\n\n"
        "*Written by `formwork schema --markdown -o docs/scene.md` from the table that reads the file.*\n\n"
        "JSON with comments (`//`, `/* */`). SI units (m, kg, s, N, Pa) except where a key's name or meaning says otherwise. File\n"
        "names are looked up beside the scene file first, then in the working directory. An unknown key is an error with a\n"
        "suggestion. Any key below `formwork` can be overridden on the command line: `--set inflate.solver.tolerance=1e-6`; from\n"
        "the root with a slash: `--set /gravity=[0,0,-9.81]`. `formwork check SCENE` prints the file with every default filled\n"
        "in. Editors complete keys when the file names its schema: `\"$schema\": \"scene.schema.json\"` (`formwork schema -o\n"
        "scene.schema.json`).\n\n"
        "## What `formwork` adds to an ArcSim scene\n";
    reference.section("formwork", *schema.find("properties")->find("formwork"));
    reference.section("", schema, "formwork");
    return reference.out;
}

}  // namespace formwork
