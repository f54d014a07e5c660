#include "arcsim/base/json_reader.hpp"

#include <algorithm>

#include "arcsim/base/text.hpp"

namespace arcsim {

namespace {

const JsonValue empty_object = JsonValue::object();

// The member of `object` that looks like `key` and is not one of the keys read so far; empty when there is none.
std::string misspelt(const JsonValue& object, const std::string& key, const std::vector<std::string>& known) {
    std::vector<std::string> others;
    for (const auto& [name, value] : object.members)
        if (std::find(known.begin(), known.end(), name) == known.end()) others.push_back(name);
    return nearest_word(key, others);
}

}  // namespace

ParamsReader::ParamsReader(const JsonNode& node, Warnings& warnings, Unsupported unsupported)
    : warnings_(warnings), unsupported_(unsupported) {
    push(node);
}

void ParamsReader::push(const JsonNode& node) {
    if (node.kind() != JsonKind::object) node.fail("expected an object { ... }, got " + node.shown() + ".");
    levels_.push_back({node, {}});
}

void ParamsReader::leave() {
    const Level& level = levels_.back();
    for (const auto& [key, value] : level.node.value().members) {
        if (std::find(level.known.begin(), level.known.end(), key) != level.known.end()) continue;
        const JsonNode node(level.node.document(), value, level.node.pointer() + "/" + key);
        const std::string guess = nearest_word(key, level.known);
        std::vector<std::string> known = level.known;
        std::sort(known.begin(), known.end());
        known.erase(std::unique(known.begin(), known.end()), known.end());
        const std::string text = node.place() + "is not a known key." + (guess.empty() ? "" : " Did you mean \"" + guess + "\"?") +
                                 (known.empty() ? "" : " Known: " + join(known) + ".");
        if (unsupported_ == Unsupported::error) throw UnknownKeyError(text, key, !guess.empty());
        warnings_.push_back(text + " Ignored as asked.");
    }
    levels_.pop_back();
}

void ParamsReader::finish() { leave(); }

std::optional<JsonNode> ParamsReader::get(const Field& f) {
    Level& level = levels_.back();
    level.known.emplace_back(f.key);
    const JsonValue* v = level.node.value().find(f.key);
    if (v) return JsonNode(level.node.document(), *v, level.node.pointer() + "/" + f.key);
    if (f.is_required) {
        const std::string guess = misspelt(level.node.value(), f.key, level.known);
        level.node.fail(std::string("the key \"") + f.key + "\" is missing" + (*f.unit ? std::string(" (") + f.unit + ")" : "") + "." +
                        (guess.empty() ? "" : " Is \"" + guess + "\" meant to be it?") + (*f.doc ? std::string(" ") + f.doc : ""));
    }
    return {};
}

void ParamsReader::value(const Field& f, bool& v) {
    if (const auto node = get(f)) v = node->boolean();
}
void ParamsReader::value(const Field& f, int& v) {
    if (const auto node = get(f)) v = node->integer(f.range, f.doc);
}
void ParamsReader::value(const Field& f, double& v) {
    if (const auto node = get(f)) v = node->number(f.range, f.unit, f.doc);
}
void ParamsReader::value(const Field& f, std::string& v) {
    if (const auto node = get(f)) v = node->string();
}
void ParamsReader::value(const Field& f, InputFile& v) {
    if (const auto node = get(f)) v = node->file();
}
void ParamsReader::value(const Field& f, std::vector<double>& v) {
    const auto node = get(f);
    if (!node) return;
    v.clear();
    for (int i = 0; i < node->size(); ++i) v.push_back((*node)[i].number(f.range, f.unit, f.doc));
}
void ParamsReader::value(const Field& f, std::vector<int>& v) {
    const auto node = get(f);
    if (!node) return;
    v.clear();
    for (int i = 0; i < node->size(); ++i) v.push_back((*node)[i].integer(f.range, f.doc));
}
void ParamsReader::value(const Field& f, std::vector<std::string>& v) {
    const auto node = get(f);
    if (!node) return;
    v.clear();
    for (int i = 0; i < node->size(); ++i) v.push_back((*node)[i].string());
}
void ParamsReader::fixed_array(const Field& f, double* v, int n) {
    const auto node = get(f);
    if (!node) return;
    if (node->kind() != JsonKind::array || node->size() != n)
        node->fail("expected an array of " + std::to_string(n) + " numbers" + (*f.unit ? std::string(" (") + f.unit + ")" : "") +
                   ", got " + node->shown() + "." + (*f.doc ? std::string(" ") + f.doc : ""));
    for (int i = 0; i < n; ++i) v[i] = (*node)[i].number(f.range, f.unit, f.doc);
}

void ParamsReader::name_or_index_field(const Field& f, std::string& v) {
    const auto node = get(f);
    if (node && node->kind() == JsonKind::number) v = std::to_string(node->integer(non_negative, f.doc));
    else if (node && node->kind() == JsonKind::string) v = node->string();
    else if (node) node->fail("expected a name or a number, got " + node->shown() + ". " + f.doc);
}

void ParamsReader::choice_field(const Field& f, int& index, const std::vector<Choice>& choices) {
    const auto node = get(f);
    if (!node) return;
    std::vector<std::string> names;
    for (const Choice& c : choices) names.emplace_back(c.name);
    const auto found = node->kind() == JsonKind::string
                           ? std::find(names.begin(), names.end(), node->string()) : names.end();
    if (found == names.end()) {
        const std::string guess = node->kind() == JsonKind::string ? nearest_word(node->string(), names) : "";
        node->fail("expected one of \"" + join(names, "\", \"") + "\", got " + node->shown() + "." +
                   (guess.empty() ? "" : " Did you mean \"" + guess + "\"?"));
    }
    index = static_cast<int>(found - names.begin());
}

bool ParamsReader::begin_optional(const Field& f, bool) {
    Level& level = levels_.back();
    const JsonValue* v = level.node.value().find(f.key);
    if (v && v->kind != JsonKind::null) return true;
    level.known.emplace_back(f.key);
    return false;
}

bool ParamsReader::enter(const Field& f, Presence presence) {
    const auto node = get(f);
    const bool given = node && node->kind() != JsonKind::null;
    if (!given && presence != Presence::always) return false;
    if (given) {
        push(*node);
    } else {
        const JsonNode& parent = levels_.back().node;
        push(JsonNode(parent.document(), empty_object, parent.pointer() + "/" + f.key));
    }
    return true;
}

int ParamsReader::begin_list(const Field& f, int) {
    const auto node = get(f);
    if (!node) return -1;
    const int n = node->size();
    lists_.push_back(*node);
    return n;
}

void ParamsReader::enter_item(int index) { push(lists_.back()[index]); }

void ParamsReader::direction(const char* key, Vector3d& v, const char* doc) {
    const auto node = get({key, "", doc, any_number, false});
    if (!node) return;
    if (node->kind() == JsonKind::string) {
        std::string_view name = node->string();
        const double sign = name.starts_with('-') ? -1 : 1;
        if (name.starts_with('-') || name.starts_with('+')) name.remove_prefix(1);
        if (name.size() == 1 && name[0] >= 'x' && name[0] <= 'z') {
            v = sign * Vector3d::Unit(name[0] - 'x');
            return;
        }
    } else if (node->kind() == JsonKind::array && node->size() == 3) {
        const Vector3d given((*node)[0].number(), (*node)[1].number(), (*node)[2].number());
        if (given.norm() > 0) {
            v = given.normalized();
            return;
        }
    }
    node->fail("expected a direction: \"x\", \"y\", \"z\", \"-x\", \"-y\", \"-z\" or three numbers, not all 0; got " +
               node->shown() + ". " + doc);
}

void ParamsReader::raw(const char* key, JsonValue& v, const char* doc) {
    if (const auto node = get({key, "", doc, any_number, false})) v = node->value();
}

void ParamsReader::exactly_one_of(std::initializer_list<const char*> keys) {
    const JsonNode& node = levels_.back().node;
    int n = 0;
    std::vector<std::string> names;
    for (const char* key : keys) n += node.has(key), names.emplace_back(key);
    if (n != 1)
        node.fail("give exactly one of \"" + join(names, "\", \"") + "\"; " + (n == 0 ? "none" : std::to_string(n)) + " given.");
}

void ParamsReader::check(bool ok, const char* key, const std::string& remedy) {
    if (ok) return;
    const JsonNode& node = levels_.back().node;
    if (node.value().find(key)) node.at(key).fail(remedy);
    node.fail("\"" + std::string(key) + "\": " + remedy);
}

void ParamsReader::ignored(const char* key, const char* why) {
    if (const auto node = get({key, "", "", any_number, false}))
        warnings_.push_back(node->place() + "ignored: " + why);
}

void ParamsReader::unsupported(const char* key, const std::string& remedy) {
    const auto node = get({key, "", "", any_number, false});
    if (!node) return;
    if (unsupported_ == Unsupported::error) node->fail("is not supported. " + remedy);
    warnings_.push_back(node->place() + "not supported, ignored as asked; the result is not ArcSim's.");
}

JsonKind ParamsReader::kind(const char* key) const {
    const JsonValue* v = levels_.back().node.value().find(key);
    return v ? v->kind : JsonKind::absent;
}

}  // namespace arcsim
