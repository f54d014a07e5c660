#include <catch2/catch.hpp>

#include "arcsim/base/error.hpp"
#include "arcsim/base/json_reader.hpp"
#include "arcsim/base/params_schema.hpp"
#include "arcsim/base/params_writer.hpp"

namespace {

using namespace arcsim;

enum class Law { secant, separable };
constexpr std::array law_names{EnumName{Law::secant, "secant", "k at the stretch"},
                               EnumName{Law::separable, "separable", "a potential"}};

struct Spring {
    int node = 0;
    std::optional<double> stiffness;
};
template <class A>
void visit(A& a, Spring& p) {
    a.required("node", p.node, "", non_negative, "Where it acts.");
    a.optional("stiffness", p.stiffness, "N/m", positive, "How stiff.");
}

struct Fill {
    std::optional<double> level, volume;
};
template <class A>
void visit(A& a, Fill& p) {
    a.optional("level", p.level, "m", any_number, "Height of the free surface.");
    a.optional("volume", p.volume, "m³", positive, "Volume of liquid.");
    a.exactly_one_of({"level", "volume"});
}

struct Bag {
    double density = 0;
    Vector3d centre{0, 0, 1};
    Vector3d up{0, 0, 1};
    bool weight = true;
    Law law = Law::secant;
    std::vector<Spring> springs;
    std::optional<Fill> fill;
    std::vector<int> nodes{1, 2};
    double end_time = std::numeric_limits<double>::infinity();
};
template <class A>
void visit(A& a, Bag& p) {
    a.required("density", p.density, "kg/m³", positive, "Density of the liquid plaster.");
    a.optional("centre", p.centre, "m", any_number, "Of the bag.");
    a.direction("up", p.up, "Against gravity.");
    a.optional("weight", p.weight, "Own weight.");
    a.choice("law", p.law, law_names, "The law.");
    a.list("springs", p.springs, "Springs.");
    a.nested("fill", p.fill, "The liquid.");
    a.when(p.law == Law::separable, [&] { a.optional("nodes", p.nodes, "", non_negative, "Some nodes."); });
    a.optional("end_time", p.end_time, "s", positive, "When to stop.");
    a.ignored("friction", "nothing touches");
    a.unsupported("obstacles", "Remove them.");
}

Bag read(const std::string& text) {
    Warnings warnings;
    Bag bag;
    const JsonDocument document = parse_json(text, "bag.json");
    read_params(document, bag, warnings);
    return bag;
}

std::string error_of(const std::string& text) {
    try {
        read(text);
    } catch (const InputError& e) {
        return e.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("A struct is read from JSON with comments, and defaults stay") {
    const Bag bag = read(R"(// a bag
        {"density": 1500, "up": "-y", "law": "separable", "nodes": [4], /* two */ "springs": [{"node": 3}, {"node": 4, "stiffness": 2e3}],
         "fill": {"level": 0.25, "volume": null}})");
    CHECK(bag.density == 1500);
    CHECK(bag.centre == Vector3d(0, 0, 1));
    CHECK(bag.up == Vector3d(0, -1, 0));
    CHECK(bag.law == Law::separable);
    REQUIRE(bag.springs.size() == 2);
    CHECK_FALSE(bag.springs[0].stiffness);
    CHECK(bag.springs[1].stiffness == 2e3);
    CHECK(bag.fill->level == 0.25);
    CHECK(bag.nodes == std::vector<int>{4});
}

TEST_CASE("Errors of the reader name file, line, column, pointer, value, range and remedy") {
    CHECK(error_of("{\n  \"density\": -1}") ==
          "bag.json:2:14: /density: expected a number > 0 (kg/m³), got -1. Density of the liquid plaster.");
    CHECK(error_of("{\"density\": 1,\n \"centr\": [0,0,0]}").find("bag.json:2:11: /centr: is not a known key. Did you mean \"centre\"? Known: centre, density") == 0);
    CHECK(error_of("{}") == "bag.json:1:1: /: the key \"density\" is missing (kg/m³). Density of the liquid plaster.");
    CHECK(error_of("{\"densty\": 1}") ==
          "bag.json:1:1: /: the key \"density\" is missing (kg/m³). Is \"densty\" meant to be it? Density of the liquid plaster.");
    CHECK(error_of(R"({"density": "1"})") ==
          "bag.json:1:13: /density: expected a number > 0 (kg/m³), got \"1\". Density of the liquid plaster.");
    CHECK(error_of(R"({"density": 1, "law": "secnat"})") ==
          "bag.json:1:23: /law: expected one of \"secant\", \"separable\", got \"secnat\". Did you mean \"secant\"?");
    CHECK(error_of(R"({"density": 1, "centre": [1, 2]})") ==
          "bag.json:1:26: /centre: expected an array of 3 numbers (m), got an array of 2. Of the bag.");
    CHECK(error_of("{\"density\": 1, // c\n \"springs\": [{\"node\": 1.5}]}") ==
          "bag.json:2:23: /springs/0/node: expected an integer >= 0, got 1.5. Where it acts.");
    CHECK(error_of(R"({"density": 1, "fill": {}})") ==
          "bag.json:1:24: /fill: give exactly one of \"level\", \"volume\"; none given.");
    CHECK(error_of(R"({"density": 1, "fill": {"level": 1, "volume": 2}})") ==
          "bag.json:1:24: /fill: give exactly one of \"level\", \"volume\"; 2 given.");
    CHECK(error_of(R"({"density": 1, "nodes": [1]})").find("/nodes: is not a known key") != std::string::npos);
    CHECK(error_of(R"({"density": 1, "obstacles": []})") == "bag.json:1:29: /obstacles: is not supported. Remove them.");
    CHECK(error_of(R"({"density": 1, "density": 2})") ==
          "bag.json:1:16: the key \"density\" appears twice in one object. Keep one.");
    CHECK(error_of("[1]") == "bag.json:1:1: /: expected an object { ... }, got an array of 1.");
}

TEST_CASE("Malformed JSON is an error with its line and column") {
    const std::string e = error_of("{\"density\": 1,\n  \"up\" \"x\"}");
    CHECK(e.find("bag.json:2:") == 0);
    CHECK(e.find("not valid JSON") != std::string::npos);
    CHECK(error_of("").find("not valid JSON") != std::string::npos);
    CHECK(error_of("{\"density\": NaN}").find("bag.json:1:") == 0);
    CHECK(error_of("{\"density\": 1e999}").find("bag.json:1:") == 0);
    CHECK(error_of("version https://git-lfs.github.com/spec/v1\n").find("git lfs pull") != std::string::npos);
    CHECK(error_of(std::string(100000, '[')).find("nested deeper") != std::string::npos);
}

TEST_CASE("The place of every value is known, whatever stands before it") {
    const JsonDocument d = parse_json("{ \"a\": 12, // x\n\"b\" : [1,-2.5e3,\n  true, null ,\"s\\\"t\"],\n\"c\":{}}", "t");
    const JsonValue& b = *d.root.find("b");
    CHECK((d.root.find("a")->line == 1 && d.root.find("a")->column == 8));
    CHECK((b.line == 2 && b.column == 7));
    CHECK((b.items[0].line == 2 && b.items[0].column == 8));
    CHECK((b.items[1].line == 2 && b.items[1].column == 10));
    CHECK((b.items[2].line == 3 && b.items[2].column == 3));
    CHECK((b.items[3].line == 3 && b.items[3].column == 9));
    CHECK((b.items[4].line == 3 && b.items[4].column == 15));
    CHECK((d.root.find("c")->line == 4 && d.root.find("c")->column == 5));
}

TEST_CASE("Unsupported keys become warnings when asked, ignored keys always are") {
    const JsonDocument document = parse_json(R"({"density": 1, "friction": 0.6, "obstacles": [1]})", "bag.json");
    Warnings warnings;
    Bag bag;
    read_params(document, bag, warnings, Unsupported::warn);
    REQUIRE(warnings.size() == 2);
    CHECK(warnings[0] == "bag.json:1:28: /friction: ignored: nothing touches");
}

TEST_CASE("What is written reads back to the same") {
    Bag bag = read(R"({"density": 0.1, "law": "separable", "springs": [{"node": 3, "stiffness": 1}], "fill": {"level": 1e-3}})");
    const std::string text = to_text(write_params(bag));
    INFO(text);
    Bag again = read(text);
    CHECK(to_text(write_params(again)) == text);
    CHECK(text.find("\"volume\"") == std::string::npos);
    CHECK(text.find("end_time") == std::string::npos);
    CHECK(again.density == 0.1);
}

TEST_CASE("Overrides reach any key, make what is missing, and are named in errors") {
    JsonDocument document = parse_json(R"({"density": 1, "springs": [{"node": 1}]})", "bag.json");
    override_value(document.root, {"fill", "level"}, "0.5", "--set fill.level=0.5");
    override_value(document.root, {"springs", "0", "node"}, "7", "--set springs.0.node=7");
    override_value(document.root, {"law"}, "separable", "--set law=separable");
    Warnings warnings;
    Bag bag;
    read_params(document, bag, warnings);
    CHECK(bag.fill->level == 0.5);
    CHECK(bag.springs[0].node == 7);
    CHECK(bag.law == Law::separable);
    CHECK_THROWS_WITH(override_value(document.root, {"density", "x"}, "1", "--set density.x=1"), Catch::Contains("--set density.x=1"));
    override_value(document.root, {"density"}, "-3", "--set density=-3");
    CHECK_THROWS_WITH(read_params(document, bag, warnings),
                      "--set density=-3: /density: expected a number > 0 (kg/m³), got -3. Density of the liquid plaster.");
}

TEST_CASE("The schema holds types, ranges, defaults, enums and the required keys") {
    const JsonValue s = schema_of<Bag>();
    const std::string text = to_text_one_line(s);
    INFO(to_text(s));
    CHECK(text.find(R"("required": ["density"])") != std::string::npos);
    const JsonValue& p = *s.find("properties");
    CHECK(to_text_one_line(*p.find("density")) ==
          R"({"type": "number", "exclusiveMinimum": 0, "description": "Density of the liquid plaster. Unit: kg/m³."})");
    CHECK(p.find("law")->find("default")->string == "secant");
    CHECK(p.find("springs")->find("items")->find("properties")->find("stiffness")->find("type")->items.size() == 2);
    CHECK(p.find("fill")->find("oneOf")->items.size() == 2);
    CHECK(p.find("nodes") != nullptr);
    CHECK(p.find("end_time")->find("default") == nullptr);
}
