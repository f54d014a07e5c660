#pragma once

#include <filesystem>
#include <vector>

#include "arcsim/base/archive.hpp"
#include "arcsim/base/json_value.hpp"

namespace arcsim {

/// Writes structs as JSON through their `visit`: the effective scene, every default included. Values that
/// were not given appear as null, infinite ones are left out. Use write_params.
class ParamsWriter final : public Archive {
public:
    /// File names are written relative to `base`, so that the text works when saved there; empty: as given.
    explicit ParamsWriter(std::filesystem::path base) : base_(std::move(base)) { levels_.push_back(JsonValue::object()); }
    JsonValue take() { return std::move(levels_.front()); }

    void direction(const char* key, Vector3d& v, const char* doc) override;
    void raw(const char* key, JsonValue& v, const char*) override { levels_.back().set(key, v); }
    void exactly_one_of(std::initializer_list<const char*> keys) override;
    void check(bool, const char*, const std::string&) override {}
    void ignored(const char*, const char*) override {}
    void unsupported(const char*, const std::string&) override {}
    JsonKind kind(const char*) const override { return JsonKind::absent; }

private:
    void value(const Field& f, bool& v) override { put(f, v); }
    void value(const Field& f, int& v) override { put(f, v); }
    void value(const Field& f, double& v) override;
    void value(const Field& f, std::string& v) override { put(f, v); }
    void value(const Field& f, InputFile& v) override;
    void value(const Field& f, std::vector<double>& v) override { put_array(f, v); }
    void value(const Field& f, std::vector<int>& v) override { put_array(f, v); }
    void value(const Field& f, std::vector<std::string>& v) override { put_array(f, v); }
    void fixed_array(const Field& f, double* v, int n) override;
    void name_or_index_field(const Field& f, std::string& v) override;
    void choice_field(const Field& f, int& index, const std::vector<Choice>& choices) override;
    bool begin_optional(const Field& f, bool has_value) override;
    bool end_optional() override { return false; }
    bool enter(const Field& f, Presence presence) override;
    int begin_list(const Field& f, int size) override;
    void enter_item(int index) override;
    void end_list() override;
    void leave() override;
    bool begin_when(bool condition) override { return condition; }
    void end_when() override {}

    template <class T>
    void put(const Field& f, const T& v) {
        levels_.back().set(f.key, JsonValue(v));
    }
    template <class T>
    void put_array(const Field& f, const std::vector<T>& v) {
        JsonValue array = JsonValue::array();
        for (const T& item : v) array.add(JsonValue(item));
        levels_.back().set(f.key, std::move(array));
    }

    std::filesystem::path base_;
    std::vector<JsonValue> levels_;      // the object being written, below it its parents
    std::vector<std::string> keys_;      // where each level goes in its parent; "" in a list
    std::vector<std::string> list_keys_;
    std::vector<JsonValue> lists_;
};

template <class P>
JsonValue write_params(P& p, const std::filesystem::path& base = {}) {
    ParamsWriter writer(base);
    visit(static_cast<Archive&>(writer), p);
    return writer.take();
}

}  // namespace arcsim
