#include "arcsim/base/params_writer.hpp"

#include <algorithm>
#include <cmath>

#include "arcsim/base/text.hpp"

namespace arcsim {

void ParamsWriter::value(const Field& f, double& v) {
    if (std::isfinite(v)) put(f, v);
}

void ParamsWriter::value(const Field& f, InputFile& v) {
    namespace fs = std::filesystem;
    if (v.name.empty()) return;   // not given: an empty name would not read back
    std::string name = v.name;
    if (!base_.empty() && !v.path.empty()) {
        std::error_code error;
        const fs::path relative = fs::relative(v.path, base_, error);
        if (!error && !relative.empty()) name = relative.generic_string();
    }
    put(f, name);
}

void ParamsWriter::fixed_array(const Field& f, double* v, int n) { put_array(f, std::vector<double>(v, v + n)); }

void ParamsWriter::name_or_index_field(const Field& f, std::string& v) {
    long index = 0;
    if (parse_integer(v, index)) put(f, static_cast<int>(index));
    else put(f, v);
}

void ParamsWriter::choice_field(const Field& f, int& index, const std::vector<Choice>& choices) {
    if (index >= 0) put(f, choices[index].name);
}

void ParamsWriter::direction(const char* key, Vector3d& v, const char*) {
    put_array({key, "", "", any_number, false}, std::vector<double>(v.data(), v.data() + 3));
}

void ParamsWriter::exactly_one_of(std::initializer_list<const char*> keys) {
    auto& members = levels_.back().members;
    std::erase_if(members, [&](const auto& member) {
        return member.second.kind == JsonKind::null && std::find(keys.begin(), keys.end(), member.first) != keys.end();
    });
}

bool ParamsWriter::begin_optional(const Field& f, bool has_value) {
    if (!has_value) levels_.back().set(f.key, JsonValue());
    return has_value;
}

bool ParamsWriter::enter(const Field& f, Presence presence) {
    if (presence == Presence::missing) {
        levels_.back().set(f.key, JsonValue());
        return false;
    }
    levels_.push_back(JsonValue::object());
    keys_.emplace_back(f.key);
    return true;
}

int ParamsWriter::begin_list(const Field& f, int size) {
    lists_.push_back(JsonValue::array());
    list_keys_.emplace_back(f.key);
    return size;
}

void ParamsWriter::enter_item(int) {
    levels_.push_back(JsonValue::object());
    keys_.emplace_back();
}

void ParamsWriter::leave() {
    JsonValue done = std::move(levels_.back());
    levels_.pop_back();
    const std::string key = std::move(keys_.back());
    keys_.pop_back();
    if (key.empty()) lists_.back().add(std::move(done));
    else levels_.back().set(key, std::move(done));
}

void ParamsWriter::end_list() {
    levels_.back().set(list_keys_.back(), std::move(lists_.back()));
    lists_.pop_back();
    list_keys_.pop_back();
}

}  // namespace arcsim
