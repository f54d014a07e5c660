#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <sstream>

#include "arcsim/mesh/obj_io.hpp"
#include "arcsim/scene/read_scene.hpp"
#include "arcsim/scene/simulation.hpp"
#include "tests/paths.hpp"

using namespace arcsim;

namespace {

struct GoldenFrame {
    double time;
    std::string file;
};

/// Frames by (scene, time step).
std::map<std::pair<std::string, double>, std::vector<GoldenFrame>> golden_frames() {
    std::map<std::pair<std::string, double>, std::vector<GoldenFrame>> cases;
    std::ifstream table(test_data_dir() + "/arcsim/golden.csv");
    std::string line;
    std::getline(table, line);
    while (std::getline(table, line)) {
        std::istringstream fields(line);
        std::string scene, h, t, file;
        std::getline(fields, scene, ',');
        std::getline(fields, h, ',');
        std::getline(fields, t, ',');
        std::getline(fields, file, ',');
        cases[{scene, std::stod(h)}].push_back({std::stod(t), file});
    }
    return cases;
}

double largest_distance(const ClothMesh& a, const ClothMesh& b) {
    double d = 0;
    for (int i = 0; i < b.n_nodes(); ++i) d = std::max(d, (a.x[i] - b.x[i]).norm());
    return d;
}

/// The frames carry six digits.
double tolerance(const ClothMesh& reference) {
    double largest = 0;
    for (const Vector3d& x : reference.x) largest = std::max(largest, x.cwiseAbs().maxCoeff());
    return largest > 1 ? 2e-5 : 1e-6;
}

}  // namespace

TEST_CASE("frames agree with those that ArcSim wrote for the same scenes") {
    const auto cases = golden_frames();
    REQUIRE(cases.size() >= 20);
    for (const auto& [key, frames] : cases) {
        Scene scene = read_scene(test_data_dir() + "/arcsim/" + key.first + ".json");
        SceneParams& p = scene.params;
        p.frame_steps = static_cast<int>(std::lround(*p.frame_time / key.second));
        Simulation simulation(p, scene.motions);
        for (const GoldenFrame& frame : frames) {
            while (simulation.time() < frame.time - 0.5 * p.step()) simulation.step();
            const ClothMesh reference = read_obj(test_data_dir() + "/arcsim/" + frame.file);
            const ClothMesh ours = simulation.cloths()[0].frame();
            REQUIRE(ours.n_nodes() == reference.n_nodes());
            INFO(key.first << " h " << key.second << " t " << frame.time);
            CHECK(largest_distance(ours, reference) <= tolerance(reference));
        }
    }
}
