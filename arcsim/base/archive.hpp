#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "arcsim/base/types.hpp"

/// How a parameter struct says what its JSON looks like: once.
///
///     struct PlasterParams {
///         double density = 0;               // rho, kg/m³
///         double gravity = 9.81;            // m/s²
///         std::optional<double> volume;     // m³; absent or null: not given
///         Jacobian jacobian = Jacobian::consistent;
///         SolverParams solver;
///     };
///     template <class Archive>
///     void visit(Archive& a, PlasterParams& p) {
///         a.required("density", p.density, "kg/m³", non_negative, "Density of the liquid plaster.");
///         a.optional("gravity", p.gravity, "m/s²", positive, "Acceleration of gravity.");
///         a.optional("volume", p.volume, "m³", positive, "Volume of liquid.");
///         a.choice("jacobian", p.jacobian, jacobian_names, "Which derivative of the pressure.");
///         a.nested("solver", p.solver, "How the equilibrium is found.");
///     }
///     inline constexpr std::array jacobian_names{
///         EnumName{Jacobian::none, "none", "left out"}, EnumName{Jacobian::consistent, "consistent", "exact"}};
///
/// The same visit reads the file (json_reader.hpp), writes the effective scene (params_writer.hpp) and the
/// JSON Schema with defaults, units and documentation (params_schema.hpp). `visit` may be a template, as
/// above, or a plain function `void visit(arcsim::Archive&, P&)` with its body in a .cpp file; it must be
/// found by the struct's namespace. A member initialiser is the default of an optional key.
///
/// Types of a key: bool, int, double, std::string, InputFile, Vector2d/Vector3d, std::array<double, N>,
/// std::vector<double|int|std::string>, std::optional of all of these (null and absent both mean "not
/// given"); enums by `choice`; structs by `nested` (also std::optional<P>) and `list` (std::vector<P>).
/// A nested struct that is absent in the file is visited as the empty object, so its required keys are
/// asked for; make it std::optional<P> when its absence means "off".
///
/// Also: `exactly_one_of({...})` after a group of optionals; `when(condition, [&] {...})` for keys that
/// exist only for one choice; `check(ok, key, remedy)` for relations between values; `ignored(key, why)`
/// and `unsupported(key, remedy)` for keys of a foreign format. Every error of a reader is an InputError
/// that names file:line:column, JSON pointer, what was read, what is allowed, and the doc sentence.
namespace arcsim {

struct JsonValue;

/// Allowed numbers: an interval, each end open or closed.
struct Range {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool open_min = false, open_max = false;

    bool contains(double v) const {
        return (open_min ? v > min : v >= min) && (open_max ? v < max : v <= max);
    }
    std::string words(std::string_view noun) const;   // "a number > 0", "an integer from 1 to 6"
};
inline constexpr Range any_number{};
inline constexpr Range positive{.min = 0, .open_min = true};
inline constexpr Range non_negative{.min = 0};
inline constexpr Range unit_interval{.min = 0, .max = 1};
constexpr Range at_least(double low) { return {.min = low}; }
constexpr Range above(double low) { return {.min = low, .open_min = true}; }
constexpr Range between(double low, double high) { return {.min = low, .max = high}; }

/// One value of an enum key: its name in the file and what it means.
template <class E>
struct EnumName {
    E value;
    const char* name;
    const char* doc = "";
};
template <class E>
EnumName(E, const char*) -> EnumName<E>;
template <class E>
EnumName(E, const char*, const char*) -> EnumName<E>;

template <class E, std::size_t N>
std::string_view name_of(const std::array<EnumName<E>, N>& names, E value) {
    for (const EnumName<E>& n : names)
        if (n.value == value) return n.name;
    return "?";
}

/// A file that the input names. `name` is what was written; `path` is where it was found: beside the file
/// that names it first, then in the working directory.
struct InputFile {
    std::string name;
    std::filesystem::path path;
};

enum class JsonKind { absent, null, boolean, number, string, array, object };

/// What `visit` functions talk to: see the example at the top of this file.
class Archive {
public:
    virtual ~Archive() = default;

    template <class T>
    void required(const char* key, T& v, const char* unit, const Range& range, const char* doc) {
        value({key, unit, doc, range, true}, v);
    }
    template <class T>
    void required(const char* key, T& v, const char* unit, const char* doc) {
        value({key, unit, doc, any_number, true}, v);
    }
    template <class T>
    void required(const char* key, T& v, const char* doc) {
        value({key, "", doc, any_number, true}, v);
    }
    template <class T>
    void optional(const char* key, T& v, const char* unit, const Range& range, const char* doc) {
        value({key, unit, doc, range, false}, v);
    }
    template <class T>
    void optional(const char* key, T& v, const char* unit, const char* doc) {
        value({key, unit, doc, any_number, false}, v);
    }
    template <class T>
    void optional(const char* key, T& v, const char* doc) {
        value({key, "", doc, any_number, false}, v);
    }

    /// An enum by the names in a table (std::array of EnumName). Optional unless `is_required`.
    template <class E, std::size_t N>
    void choice(const char* key, E& v, const std::array<EnumName<E>, N>& names, const char* doc,
                bool is_required = false) {
        std::vector<Choice> choices;
        int index = -1;
        for (std::size_t i = 0; i < N; ++i) {
            choices.push_back({names[i].name, names[i].doc});
            if (names[i].value == v) index = static_cast<int>(i);
        }
        choice_field({key, "", doc, any_number, is_required}, index, choices);
        if (index >= 0) v = names[index].value;
    }

    /// A struct of its own, as a JSON object.
    template <class P>
    void nested(const char* key, P& p, const char* doc) {
        if (!enter({key, "", doc, any_number, false}, Presence::always)) return;
        visit(*this, p);
        leave();
    }
    /// A struct whose absence (or null) means "off".
    template <class P>
    void nested(const char* key, std::optional<P>& p, const char* doc) {
        if (!enter({key, "", doc, any_number, false}, p ? Presence::given : Presence::missing)) return;
        if (!p) p.emplace();
        visit(*this, *p);
        leave();
    }
    /// An array of structs; absent means empty.
    template <class P>
    void list(const char* key, std::vector<P>& items, const char* doc) {
        const int n = begin_list({key, "", doc, any_number, false}, static_cast<int>(items.size()));
        if (n < 0) return;
        items.resize(n);
        for (int i = 0; i < n; ++i) {
            enter_item(i);
            visit(*this, items[i]);
            leave();
        }
        end_list();
    }

    /// Keys that exist only while `condition` holds (documentation shows them all).
    template <class Body>
    void when(bool condition, Body&& body) {
        if (!begin_when(condition)) return;
        body();
        end_when();
    }

    /// A name or a whole number, kept as text; optional.
    void name_or_index(const char* key, std::optional<std::string>& v, const char* doc) {
        const Field f{key, "", doc, any_number, false};
        if (!begin_optional(f, v.has_value())) return v.reset();
        const bool had_value = v.has_value();
        if (!had_value) v.emplace();
        name_or_index_field(f, *v);
        if (end_optional() && !had_value) v.reset();
    }

    /// A direction in space, made a unit vector: [x, y, z] or "x", "y", "z", "-x", "-y", "-z".
    virtual void direction(const char* key, Vector3d& v, const char* doc) = 0;
    /// A part of the file as it stands, for formats that no visit describes; a JsonNode reads it afterwards.
    virtual void raw(const char*, JsonValue&, const char*) {}
    /// Of these optional keys exactly one must be given.
    virtual void exactly_one_of(std::initializer_list<const char*> keys) = 0;
    /// A relation between values; `remedy` is the sentence shown at `key` when it does not hold.
    virtual void check(bool ok, const char* key, const std::string& remedy) = 0;
    /// A key of a foreign format that changes nothing here: accepted, one warning.
    virtual void ignored(const char* key, const char* why) = 0;
    /// A key of a foreign format that would change the result: an error, unless the reader was told to ignore.
    virtual void unsupported(const char* key, const std::string& remedy) = 0;
    /// What the file holds at `key`; `absent` when this archive is not reading.
    virtual JsonKind kind(const char* key) const = 0;

protected:
    struct Field {
        const char* key;
        const char* unit;
        const char* doc;
        Range range;
        bool is_required;
    };
    struct Choice {
        const char* name;
        const char* doc;
    };
    enum class Presence { always, given, missing };

    virtual void value(const Field&, bool&) = 0;
    virtual void value(const Field&, int&) = 0;
    virtual void value(const Field&, double&) = 0;
    virtual void value(const Field&, std::string&) = 0;
    virtual void value(const Field&, InputFile&) = 0;
    virtual void value(const Field&, std::vector<double>&) = 0;
    virtual void value(const Field&, std::vector<int>&) = 0;
    virtual void value(const Field&, std::vector<std::string>&) = 0;
    virtual void fixed_array(const Field&, double* v, int n) = 0;
    template <int N>
    void value(const Field& f, Eigen::Matrix<double, N, 1>& v) {
        fixed_array(f, v.data(), N);
    }
    template <std::size_t N>
    void value(const Field& f, std::array<double, N>& v) {
        fixed_array(f, v.data(), static_cast<int>(N));
    }
    template <class T>
    void value(const Field& f, std::optional<T>& v) {
        if (!begin_optional(f, v.has_value())) return v.reset();
        const bool had_value = v.has_value();
        if (!had_value) v.emplace();
        value(f, *v);
        if (end_optional() && !had_value) v.reset();   // documentation only looked
    }

    virtual void name_or_index_field(const Field&, std::string& v) = 0;
    virtual void choice_field(const Field&, int& index, const std::vector<Choice>& choices) = 0;
    virtual bool begin_optional(const Field&, bool has_value) = 0;
    virtual bool end_optional() = 0;   // true: put the value back to "not given"
    virtual bool enter(const Field&, Presence) = 0;
    virtual int begin_list(const Field&, int size) = 0;   // -1: nothing to do
    virtual void enter_item(int index) = 0;
    virtual void end_list() = 0;
    virtual void leave() = 0;
    virtual bool begin_when(bool condition) = 0;
    virtual void end_when() = 0;
};

}  // namespace arcsim
