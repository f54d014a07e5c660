#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "formwork/report/base64.hpp"
#include "formwork/report/report.hpp"
#include "formwork/report/report_pictures.hpp"
#include "tests/formwork/synthetic_report.hpp"
#include "tests/output_folder.hpp"

using namespace formwork;

namespace {

/// The JSON between the tags of the report's data element.
nlohmann::json data_of(const std::string& html) {
    const std::string open = "id=\"report-data\">";
    const size_t begin = html.find(open) + open.size();
    return nlohmann::json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

}  // namespace

TEST_CASE("base64 agrees with the examples of RFC 4648") {
    CHECK(base64(std::string_view("")) == "");
    CHECK(base64(std::string_view("f")) == "Zg==");
    CHECK(base64(std::string_view("fo")) == "Zm8=");
    CHECK(base64(std::string_view("foobar")) == "Zm9vYmFy");
}

TEST_CASE(
    "the report is one file without references to other places, below 6 MB for a column of 6 000 "
    "nodes") {
    const ReportInput input = synthetic_report(96, 56);
    const OutputFolder folder("report");
    const std::filesystem::path path = folder / "report.html";
    write_report(input, path);
    CHECK(std::filesystem::file_size(path) < 6'000'000);
    std::ifstream in(path, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    const std::string html = text.str();
    for (const char* outside : {"src=\"http", "href=\"http", "@import", "url(http", "cdn."})
        CHECK(html.find(outside) == std::string::npos);
    CHECK(html.find("The MIT License") != std::string::npos);
    CHECK(html.find("{{") ==
          html.find("{{title}}"));  // no place of the template is left open: npos both

    const nlohmann::json data = data_of(html);
    CHECK(data["pictures"].size() == 13);
    CHECK(data["mesh"]["shapes"].size() == 3);
    CHECK(data["panels"].size() == 5);
    CHECK(data["fields"].size() == 13);
    CHECK(data["summary"]["inflate"]["volume_m3"] == 0.0024);
}

TEST_CASE("text of the scene cannot break out of the report's data") {
    ReportInput input = synthetic_report(16, 8);
    input.pictures.clear();
    input.title = "<b>\"&";
    input.notes = {"</script><script>alert(1)</script><!--"};
    const std::string html = compose_report(input);
    CHECK(html.find("alert(1)</script>") == std::string::npos);
    CHECK(html.find("<h1>&lt;b&gt;&quot;&amp;</h1>") != std::string::npos);
    CHECK(data_of(html)["notes"][0] == input.notes[0]);
}

TEST_CASE("a run that stopped early has a report of what there is") {
    ReportInput input = synthetic_report(16, 8);
    ReportInput early;
    early.title = "only inflated";
    early.rest = input.rest;
    early.inflated = input.inflated;
    early.inflated_strain = input.inflated_strain;
    const nlohmann::json data = data_of(compose_report(early));
    CHECK(data["mesh"]["shapes"].size() == 2);
    CHECK(data["fields"].size() == 4);
    CHECK(data["summary"].is_null());

    early.inflated_strain.pop_back();
    CHECK_THROWS_AS(compose_report(early), std::invalid_argument);
}

TEST_CASE("the viewer files of a finished run stand beside its stages") {
    const OutputFolder folder("viewer_run");
    const ReportInput input = synthetic_report(16, 8);
    const std::vector<std::string> names = write_viewer_files(input, folder / "");
    CHECK(names.size() == 5);
    for (const std::string& name : names) CHECK(std::filesystem::file_size(folder / name) > 1000);
}

TEST_CASE("the sewing order is told by the names on the sheets") {
    PanelSet set;
    set.seams.resize(3);
    set.seams[1].side[0].length = 0.2421;
    set.seams[1].side[0].panel = 0;
    set.seams[1].side[1].panel = 4;
    set.seams[2].side[0].panel = 4;
    const std::vector<ReportStep> steps =
        report_steps(set, {{StepKind::join, {1}, {0, 4}, 0}, {StepKind::hem, {2}, {4}, 0}});
    CHECK(steps[0].text == "S02: join P01 to P05, 242 mm");
    CHECK(steps[0].panels == std::vector<int>{0, 4});
    CHECK(steps[1].text == "R03: last, the pouring opening: hem the rim of P05, 0 mm");
    CHECK(steps[1].panels == std::vector<int>{4});
}
