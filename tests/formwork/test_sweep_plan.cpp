#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

#include "arcsim/base/error.hpp"
#include "formwork/study/sweep_plan.hpp"
#include "formwork/study/sweep_table.hpp"

using namespace formwork;

namespace {

SweepParameter numbers(const std::string& key, std::vector<double> values) {
    SweepParameter p;
    p.key = key;
    p.values = std::move(values);
    return p;
}

SweepParameter range(const std::string& key, double from, double to, int count) {
    SweepParameter p;
    p.key = key;
    p.from = from;
    p.to = to;
    p.count = count;
    return p;
}

}  // namespace

TEST_CASE("a grid has every combination, its last parameter varying fastest") {
    SweepParams p;
    p.parameters = {numbers("a", {1, 2}), range("b", 0, 1, 3)};
    const auto points = plan_points(p);
    REQUIRE(points.size() == 6);
    CHECK(points[1].overrides == std::vector<std::pair<std::string, std::string>>{{"a", "1"}, {"b", "0.5"}});
    CHECK(points[5].overrides == std::vector<std::pair<std::string, std::string>>{{"a", "2"}, {"b", "1"}});
    CHECK(points[5].number == 5);
}

TEST_CASE("a zip takes the values side by side and refuses unequal lengths") {
    SweepParams p;
    p.design = SweepDesign::zip;
    p.parameters = {numbers("a", {1, 2}), numbers("b", {3, 4})};
    CHECK(plan_points(p)[1].overrides[1].second == "4");
    p.parameters.push_back(numbers("c", {1, 2, 3}));
    CHECK_THROWS_AS(plan_points(p), arcsim::InputError);
}

TEST_CASE("a latin hypercube has one point in every stratum of every parameter, the same each time") {
    SweepParams p;
    p.design = SweepDesign::latin_hypercube;
    p.samples = 7;
    p.parameters = {range("a", 0, 7, 0), range("b", 10, 17, 0)};
    const auto points = plan_points(p), again = plan_points(p);
    for (int k = 0; k < 2; ++k) {
        std::vector<int> strata;
        for (const auto& point : points)
            strata.push_back(static_cast<int>(std::floor(std::stod(point.overrides[k].second) - 10 * k)));
        std::sort(strata.begin(), strata.end());
        CHECK(strata == std::vector<int>{0, 1, 2, 3, 4, 5, 6});
    }
    for (std::size_t i = 0; i < points.size(); ++i) CHECK(points[i].overrides == again[i].overrides);
}

TEST_CASE("a list takes key=value pairs and names the one that is none") {
    SweepParams p;
    p.design = SweepDesign::list;
    p.points = {{{"a.b=1", "c=[0,1]"}}, {{"a.b"}}};
    CHECK_THROWS_WITH(plan_points(p), Catch::Contains("/points/1/set"));
    p.points.pop_back();
    CHECK(plan_points(p)[0].overrides[1] == std::pair<std::string, std::string>{"c", "[0,1]"});
}

TEST_CASE("the table of a sweep quotes cells and leaves missing ones empty") {
    SweepTable t;
    t.add_row();
    t.set("a", "1,5");
    t.add_row();
    t.set("b", "say \"x\"");
    CHECK(t.csv() == "a,b\n\"1,5\",\n,\"say \"\"x\"\"\"\n");
}
