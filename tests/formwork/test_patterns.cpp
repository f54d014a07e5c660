#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "formwork/panels/pattern_files.hpp"
#include "tests/formwork/cut_surfaces.hpp"
#include "tests/output_folder.hpp"

using namespace formwork;

/// Hidden: writes patterns for the readers of tests/scripts/test_patterns.py, and for eyes; without PATTERN_FOLDER into a
/// folder that goes with the test.
TEST_CASE("patterns are written where PATTERN_FOLDER says", "[.write-patterns]") {
    const char* wanted = std::getenv("PATTERN_FOLDER");
    const OutputFolder scratch("patterns");
    const std::filesystem::path folder = wanted ? std::filesystem::path(wanted) : scratch.path();
    PatternInfo info;
    info.date = "2026-01-31";
    info.liquid_m3 = 0.0123, info.liquid_kg = 18.45, info.fabric_density = 0.2;
    const auto write = [&](const char* name, const Segmentation& s, PanelParams params) {
        const PanelSet set = make_panels(s, params);
        info.name = name;
        const PatternFiles files = write_patterns(set, s, make_pattern(set, s, info), folder / name);
        INFO(name);
        CHECK(files.names.size() == 10 + params.more_papers.size() + set.panels.size());
        CHECK(files.utilisation > 0.1);
    };
    write("sphere", cut_surfaces::sphere_in_octants(16, 0.15), {});
    write("pieces24", cut_surfaces::sphere_in_24(5, 0.15), {});
    PanelParams column;
    column.allowances = {{1, 15}};
    column.paper = Paper::a3;
    column.text = Lettering::paths;
    write("column",
          cut_surfaces::tube_in_strips(48, 24, 0.6, [](double t) { return 0.1 + 0.035 * std::cos(2 * M_PI * t) + 0.02 * t; },
                                       {0, 0.2, 0.45, 0.8}),
          column);
    arcsim::Surface cap = disk_meshes::cap(12, 24, 1.3);
    for (auto& x : cap.x) x *= 0.12;
    std::set<std::pair<int, int>> slit;
    for (int ring = 12; ring > 5; --ring) slit.insert({1 + (ring - 1) * 24, 1 + (ring - 2) * 24});
    PanelParams dart;
    dart.paper = Paper::letter;
    dart.more_papers = {"A0"};
    write("dart", cut_surfaces::cut_by_labels(cap, std::vector<int>(cap.n_faces(), 0), slit), dart);
}
