#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "arcsim/base/error.hpp"
#include "arcsim/material/material_data.hpp"
#include "tests/output_folder.hpp"

using namespace arcsim;
using Catch::Contains;

namespace {

std::string error_of(const std::string& text) {
    const OutputFolder scratch("bad_material");
    const auto file = scratch / "material.json";
    std::ofstream(file) << text;
    try {
        read_material(file);
    } catch (const InputError& e) {
        return e.what();
    }
    return "no error";
}

const std::string rows = "[1,2,3,4],[5,6,7,8],[1,2,3,4],[1,2,3,4],[1,2,3,4],[1,2,3,4],[9]";
const std::string bending = "\"bending\": [[1,2,3,4,5],[1,2,3,4,5],[1,2,3,4,6e-6]]";

}  // namespace

TEST_CASE("a material file with comments and extra rows is read") {
    const OutputFolder scratch("material");
    const auto file = scratch / "material.json";
    std::ofstream(file) << "{ // measured\n\"density\": 0.2, \"stretching\": [" << rows << "], /* */ " << bending << "}";
    const MaterialData m = read_material(file);
    CHECK(m.density == 0.2);
    CHECK(m.stretching[1][2] == 7);
    CHECK(m.bending[2][4] == 6e-6);
}

TEST_CASE("errors of a material file name the place and the expected rows") {
    CHECK_THAT(error_of("{}"), Contains("\"density\" is missing"));
    CHECK_THAT(error_of("{\"density\": 0}"), Contains("/density") && Contains("> 0"));
    CHECK_THAT(error_of("{\"density\": 1, \"stretching\": [[1,2,3,4]]}"), Contains("expected 6 rows of 4 numbers"));
    CHECK_THAT(error_of("{\"density\": 1, \"stretching\": [" + rows + "], \"bending\": [[1,2,3,4,5],[1,2],[1]]}"),
               Contains("/bending/1") && Contains("expected 5 numbers"));
    CHECK_THAT(error_of("{\"density\": 1, \"stretching\": [[1,2,\"x\",4]," + rows + "], " + bending + "}"),
               Contains("/stretching/0/2") && Contains("expected a number"));
    CHECK_THROWS_AS(read_material("no/such.json"), InputError);
}
