#pragma once

#include <vector>

#include "arcsim/base/archive.hpp"
#include "arcsim/base/json_value.hpp"

namespace arcsim {

/// Describes structs as JSON Schema (draft 7) through their `visit`: types, ranges, enums, defaults, units
/// and the doc sentences. Use schema_of.
class ParamsSchema final : public Archive {
public:
    ParamsSchema();
    JsonValue take() { return std::move(levels_.front().schema); }

    void direction(const char* key, Vector3d& v, const char* doc) override;
    void raw(const char* key, JsonValue&, const char* doc) override;
    void exactly_one_of(std::initializer_list<const char*> keys) override;
    void check(bool, const char*, const std::string&) override {}
    void ignored(const char* key, const char* why) override;
    void unsupported(const char* key, const std::string& remedy) override;
    JsonKind kind(const char*) const override { return JsonKind::absent; }

private:
    struct Level {
        JsonValue schema;
        bool nullable = false;
    };

    void value(const Field& f, bool& v) override;
    void value(const Field& f, int& v) override;
    void value(const Field& f, double& v) override;
    void value(const Field& f, std::string& v) override;
    void value(const Field& f, InputFile& v) override;
    void value(const Field& f, std::vector<double>& v) override;
    void value(const Field& f, std::vector<int>& v) override;
    void value(const Field& f, std::vector<std::string>& v) override;
    void fixed_array(const Field& f, double* v, int n) override;
    void name_or_index_field(const Field& f, std::string& v) override;
    void choice_field(const Field& f, int& index, const std::vector<Choice>& choices) override;
    bool begin_optional(const Field& f, bool has_value) override;
    bool end_optional() override;
    bool enter(const Field& f, Presence presence) override;
    int begin_list(const Field& f, int size) override;
    void enter_item(int index) override;
    void end_list() override {}
    void leave() override;
    bool begin_when(bool) override;
    void end_when() override { --when_depth_; }

    void add(const Field& f, JsonValue schema, JsonValue default_value);

    std::vector<Level> levels_;
    std::vector<std::string> keys_;
    int when_depth_ = 0;
    enum class Given { plain, nullable_without_default, nullable } given_ = Given::plain;
};

template <class P>
JsonValue schema_of() {
    P p;
    ParamsSchema schema;
    visit(static_cast<Archive&>(schema), p);
    return schema.take();
}

}  // namespace arcsim
