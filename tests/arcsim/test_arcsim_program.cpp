#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "arcsim/mesh/obj_io.hpp"
#include "tests/output_folder.hpp"
#include "tests/paths.hpp"

namespace fs = std::filesystem;
using namespace arcsim;
using Catch::Contains;

namespace {

std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

struct Result {
    int code;
    std::string errors;
};

Result run(const std::string& arguments, const fs::path& folder) {
    const fs::path log = folder / "stderr.txt";
    const int status = std::system(("\"" + arcsim_program() + "\" " + arguments + " 2> " + log.string()).c_str());
    return {WEXITSTATUS(status), text_of(log)};
}

/// A stored scene with some of its text replaced, beside its meshes.
fs::path changed_scene(const std::string& name, const fs::path& folder,
                       const std::vector<std::pair<std::string, std::string>>& changes) {
    for (const char* sub : {"meshes", "materials"})
        fs::copy(test_data_dir() + "/arcsim/" + sub, folder / sub, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    std::string text = text_of(test_data_dir() + "/arcsim/" + name + ".json");
    for (const auto& [from, to] : changes) text = std::regex_replace(text, std::regex(from), to);
    std::ofstream(folder / "scene.json") << text;
    return folder / "scene.json";
}

}  // namespace

TEST_CASE("the program writes frames, the scene and timing as ArcSim does") {
    const OutputFolder scratch("arcsim_files");
    const fs::path& dir = scratch.path();
    const fs::path scene = changed_scene("strip_iso", dir, {{"\"frame_time\": 0.4", "\"frame_time\": 0.02"},
                                                            {"\"frame_steps\": 40", "\"frame_steps\": 2"},
                                                            {"\"end_frame\": 5", "\"end_frame\": 3"}});
    const Result r = run(scene.string() + " " + (dir / "out").string() + " --quiet", dir);
    INFO(r.errors);
    REQUIRE(r.code == 0);
    for (const char* frame : {"0000_00.obj", "0003_00.obj"}) CHECK(fs::exists(dir / "out" / frame));
    CHECK_FALSE(fs::exists(dir / "out" / "0004_00.obj"));
    CHECK(text_of(dir / "out" / "conf.json") == text_of(scene));
    const std::string timing = text_of(dir / "out" / "timing");
    CHECK(std::count(timing.begin(), timing.end(), '\n') == 3);
    std::istringstream first(timing.substr(0, timing.find('\n')));
    CHECK(std::distance(std::istream_iterator<double>(first), {}) == 8);
    CHECK_THAT(text_of(dir / "out" / "0003_00.obj"), Contains("\nny ") && Contains("\nnv "));
}

TEST_CASE("a resumed run continues to the same digits") {
    for (const std::string method : {"backward_euler", "bdf2"}) {
        const OutputFolder scratch("arcsim_resume_" + method);
        const fs::path& dir = scratch.path();
        // Wind and unequal bending, so that what lags matters; a handle that takes hold after the interruption,
        // and one before.
        const fs::path scene = changed_scene(
            "comp_iso", dir,
            {{"\"frame_time\": 0.4", "\"frame_time\": 0.05"}, {"\"frame_steps\": 40", "\"frame_steps\": 5"},
             {"\"end_frame\": 5", "\"end_frame\": 6"}, {"\"wind\": \\{\"density\": 0\\}", "\"wind\": {\"velocity\": [0, 1, 3]}"},
             {"\"gravity\"", "\"solver\": {\"method\": \"" + method + "\"}, \"gravity\""},
             {"\"handles\": \\[", "\"handles\": [{\"nodes\": [220], \"start_time\": 0.12}, {\"nodes\": [221], \"start_time\": 0.24}, "}});
        REQUIRE(run(scene.string() + " " + (dir / "whole").string() + " --quiet", dir).code == 0);
        fs::copy(dir / "whole", dir / "part", fs::copy_options::recursive);
        for (const char* f : {"0004_00.obj", "0005_00.obj", "0006_00.obj"}) fs::remove(dir / "part" / f);
        const Result r = run("resume " + (dir / "part").string() + " 3 " + scene.string() + " --quiet", dir);
        INFO(method << r.errors);
        REQUIRE(r.code == 0);
        CHECK(text_of(dir / "part" / "0006_00.obj") == text_of(dir / "whole" / "0006_00.obj"));
    }
}

TEST_CASE("an interrupted run ends with exit code 130 and continues to the same bytes") {
    const OutputFolder scratch("arcsim_interrupted");
    const fs::path& dir = scratch.path();
    const auto scene = [&](int end_frame) {
        return changed_scene("comp_iso", dir, {{"\"frame_time\": 0.4", "\"frame_time\": 0.02"},
                                               {"\"frame_steps\": 40", "\"frame_steps\": 2"},
                                               {"\"end_frame\": 5", "\"end_frame\": " + std::to_string(end_frame)}});
    };
    const std::string part = (dir / "part").string();
    const std::string script = "\"" + arcsim_program() + "\" " + scene(100000).string() + " " + part + " --quiet 2>/dev/null & run=$!; " +
                               "while [ ! -e " + part + "/0003_00.obj ]; do sleep 0.01; done; kill -INT $run; wait $run";
    const int status = std::system(("sh -c '" + script + "'").c_str());
    CHECK(WEXITSTATUS(status) == 130);
    int last = 3;
    const auto frame = [](int n) { return "00" + std::string(n < 10 ? "0" : "") + std::to_string(n) + "_00.obj"; };
    while (fs::exists(dir / "part" / frame(last + 1)) && last < 95) ++last;
    const fs::path short_scene = scene(last + 2);
    const Result resumed = run("resume " + part + " " + std::to_string(last) + " " + short_scene.string() + " --quiet", dir);
    INFO(resumed.errors);
    REQUIRE(resumed.code == 0);
    REQUIRE(run(short_scene.string() + " " + (dir / "whole").string() + " --quiet", dir).code == 0);
    for (int n : {1, last, last + 1, last + 2}) CHECK(text_of(dir / "part" / frame(n)) == text_of(dir / "whole" / frame(n)));
}

TEST_CASE("several cloths run side by side, each as if it were alone") {
    using nlohmann::json;
    const OutputFolder scratch("arcsim_several");
    const fs::path& dir = scratch.path();
    const fs::path file = changed_scene("strip_iso", dir, {});
    json alone = json::parse(text_of(file));
    alone["frame_time"] = 0.05;
    alone["frame_steps"] = 5;
    alone["end_frame"] = 3;
    json moved = alone;
    moved["cloths"][0]["transform"] = {{"translate", {0.5, 0, 0}}, {"rotate", {90, 0, 0, 1}}, {"scale", 2}};
    moved["cloths"][0]["velocity"] = {{"linear", {0, 0, 0.1}}, {"angular", {0, 1, 0}}};
    json both = alone;
    both["cloths"].push_back(moved["cloths"][0]);
    for (json handle : moved["handles"]) {
        handle["cloth"] = 1;
        both["handles"].push_back(handle);
    }
    for (const auto& [name, scene] : {std::pair<std::string, json&>{"first", alone}, {"second", moved}, {"both", both}}) {
        std::ofstream(dir / (name + ".json")) << scene;
        const Result r = run((dir / (name + ".json")).string() + " " + (dir / name).string() + " --quiet", dir);
        INFO(name << r.errors);
        REQUIRE(r.code == 0);
    }
    for (const std::string n : {"0000", "0001", "0003"}) {
        CHECK(text_of(dir / "both" / (n + "_00.obj")) == text_of(dir / "first" / (n + "_00.obj")));
        CHECK(text_of(dir / "both" / (n + "_01.obj")) == text_of(dir / "second" / (n + "_00.obj")));
    }
    CHECK(text_of(dir / "both" / "0003_00.obj") != text_of(dir / "both" / "0003_01.obj"));
    CHECK_FALSE(fs::exists(dir / "first" / "0000_01.obj"));
}

TEST_CASE("a hanging sheet stays inside its strain limits, resumes to the same bytes, and ignores limits that are disabled") {
    using nlohmann::json;
    const OutputFolder scratch("arcsim_limits");
    const fs::path& dir = scratch.path();
    const json hang = json::parse(text_of(changed_scene("hang_iso", dir, {})));
    const auto largest_stretch = [](const ClothMesh& m) {
        double largest = 0;
        for (int f = 0; f < m.n_faces(); ++f) {
            const Triangle &n = m.face_nodes[f], &u = m.face_verts[f];
            Eigen::Matrix2d D;
            D << m.u[u[1]] - m.u[u[0]], m.u[u[2]] - m.u[u[0]];
            Eigen::Matrix<double, 3, 2> edges;
            edges << m.x[n[1]] - m.x[n[0]], m.x[n[2]] - m.x[n[0]];
            largest = std::max(largest, (edges * D.inverse()).operatorNorm());
        }
        return largest;
    };
    for (const std::string method : {"backward_euler", "newton_euler"}) {
        json scene = hang;
        scene["frame_time"] = 0.05;
        scene["frame_steps"] = 5;
        scene["end_frame"] = 8;
        scene["solver"]["method"] = method;
        scene["cloths"][0]["materials"][0]["strain_limits"] = {0.9, 1.02};
        const auto write = [&](const std::string& name) {
            std::ofstream(dir / (name + ".json")) << scene;
            return run((dir / (name + ".json")).string() + " " + (dir / (method + name)).string() + " --quiet", dir);
        };
        REQUIRE(write("disabled").code == 0);
        scene["disable"].erase(std::find(scene["disable"].begin(), scene["disable"].end(), "strainlimiting"));
        const Result r = write("limited");
        INFO(r.errors);
        REQUIRE(r.code == 0);
        const fs::path whole = dir / (method + "limited"), part = dir / (method + "part");
        CHECK(largest_stretch(read_obj(dir / (method + "disabled") / "0008_00.obj")) > 1.05);
        CHECK(largest_stretch(read_obj(whole / "0008_00.obj")) <= 1.02 + 2e-6);
        if (method == "backward_euler") CHECK_THAT(text_of(whole / "timing"), !Contains(" 0 0 0 0 0 0\n"));   // third column: limits
        fs::copy(whole, part, fs::copy_options::recursive);
        fs::remove(part / "0008_00.obj");
        REQUIRE(run("resume " + part.string() + " 6 " + (dir / "limited.json").string() + " --quiet", dir).code == 0);
        CHECK(text_of(part / "0008_00.obj") == text_of(whole / "0008_00.obj"));
    }
}

TEST_CASE("recorded motions, velocities in the mesh, polygons and disabled physics do what the format says") {
    using nlohmann::json;
    const OutputFolder scratch("arcsim_format");
    const fs::path& dir = scratch.path();
    json scene = json::parse(text_of(changed_scene("strip_iso", dir, {})));
    scene["frame_time"] = 0.05;
    scene["frame_steps"] = 5;
    scene["end_frame"] = 3;
    const auto last_frame = [&](const std::string& name) {
        std::ofstream(dir / (name + ".json")) << scene;
        const Result r = run((dir / (name + ".json")).string() + " " + (dir / name).string() + " --quiet", dir);
        INFO(name << r.errors);
        REQUIRE(r.code == 0);
        return text_of(dir / name / "0003_00.obj");
    };
    const std::string keyframes = last_frame("keyframes");
    const json end = scene["motions"][0][1]["transform"]["translate"];
    REQUIRE(scene["motions"][0][1]["time"] == 1);
    std::ofstream(dir / "pull.mot") << "1\n2\n0 0 0  1 0 0 0\n" << end[0] << ' ' << end[1] << ' ' << end[2] << "  1 0 0 0\n";
    scene["motions"] = {{"motfile", "pull.mot"}, {"fps", 1}};
    CHECK(last_frame("recorded") == keyframes);

    // `velocity` overwrites nv in a fresh run, and its default is rest.
    std::ofstream(dir / "meshes" / "strip.obj", std::ios::app) << "v 1 1 1\nnv 5 5 5\n";
    ClothMesh with_extra = parse_obj(last_frame("moving"), "frame");
    CHECK(with_extra.v.back() == Vector3d(0, 0, 0));

    scene["disable"].push_back("physics");
    last_frame("still");
    CHECK(read_obj(dir / "still" / "0003_00.obj").x == read_obj(dir / "still" / "0000_00.obj").x);
}

TEST_CASE("a morph draws the cloth to its target") {
    using nlohmann::json;
    const OutputFolder scratch("arcsim_morph");
    const fs::path& dir = scratch.path();
    json scene = json::parse(text_of(changed_scene("hang_iso", dir, {})));
    ClothMesh target = read_obj(dir / "meshes" / "sheet21.obj");
    for (Vector3d& x : target.x) x = Vector3d(x.x(), x.y(), 0.1 * std::sin(3 * x.x()));
    write_obj(dir / "target.obj", target);
    scene["handles"] = json::array();
    scene["morphs"] = {{{"targets", {"meshes/sheet21.obj", "target.obj"}},
                        {"spline", {{{"time", 0}, {"target", 0}, {"stiffness", 1}}, {{"time", 1}, {"target", 1}, {"stiffness", 1000}}}}}};
    for (const std::string method : {"backward_euler", "bdf2"}) {
        scene["solver"]["method"] = method;
        std::ofstream(dir / "scene.json") << scene;
        const Result r = run((dir / "scene.json").string() + " " + (dir / method).string() + " --quiet", dir);
        INFO(r.errors);
        REQUIRE(r.code == 0);
        const ClothMesh end = read_obj(dir / method / "0005_00.obj");
        // Springs of 1000 N/m carry the weight of 0.5 g a node, 5 µm, and the fabric's resistance.
        for (int i = 0; i < end.n_nodes(); ++i) CHECK((end.x[i] - target.x[i]).norm() < 2e-3);
    }
}

TEST_CASE("strain limits that hard handles exceed stop the run with exit code 3") {
    const OutputFolder scratch("arcsim_limits_exceeded");
    const fs::path& dir = scratch.path();
    const fs::path scene = changed_scene("strip_iso", dir, {{"\"strainlimiting\",", ""}, {"iso.json\"", "iso.json\", \"strain_limits\": [0.9, 1.05]"},
                                                            {"\"nodes\"", "\"hard\": true, \"nodes\""}});
    const Result r = run(scene.string() + " " + (dir / "out").string() + " --quiet", dir);
    CHECK(r.code == 3);
    CHECK_THAT(r.errors, Contains("strain limits cannot be met: face") && Contains("step ") && Contains("handles?"));
    const Result wrong = run(changed_scene("strip_iso", dir, {{"iso.json\"", "iso.json\", \"strain_limits\": [1.1, 0.9]"}}).string() + " " +
                                 (dir / "none").string() + " --quiet", dir);
    CHECK(wrong.code == 2);
    CHECK_THAT(wrong.errors, Contains("/strain_limits"));
}

TEST_CASE("frames of another program, without our resume files, are continued with a warning") {
    const OutputFolder scratch("arcsim_foreign");
    const fs::path& dir = scratch.path();
    const fs::path scene = changed_scene("strip_iso", dir, {{"\"frame_time\": 0.4", "\"frame_time\": 0.05"},
                                                            {"\"frame_steps\": 40", "\"frame_steps\": 5"},
                                                            {"\"end_frame\": 5", "\"end_frame\": 2"}});
    REQUIRE(run(scene.string() + " " + (dir / "out").string() + " --quiet", dir).code == 0);
    fs::remove_all(dir / "out" / "resume");
    const Result r = run("resume " + (dir / "out").string() + " 1 " + scene.string() + " --quiet", dir);
    CHECK(r.code == 0);
    CHECK_THAT(r.errors, Contains("reconstructed"));
    CHECK(run("resume " + (dir / "out").string() + " 7 " + scene.string() + " --quiet", dir).code == 2);
}

TEST_CASE("wrong input ends with exit code 2, names the place, and writes nothing") {
    const OutputFolder scratch("arcsim_wrong");
    const fs::path& dir = scratch.path();
    const auto expect = [&](const std::string& from, const std::string& to, const std::string& words) {
        const fs::path scene = changed_scene("strip_iso", dir, {{from, to}});
        const Result r = run(scene.string() + " " + (dir / "none").string() + " --quiet", dir);
        INFO(to);
        CHECK(r.code == 2);
        CHECK_THAT(r.errors, Contains(words));
        CHECK_FALSE(fs::exists(dir / "none"));
    };
    expect("\"gravity\"", "\"gravty\"", "Did you mean \"gravity\"?");
    expect("\"nodes\": \\[", "\"vertices\": [", "/handles/0/vertices");
    expect("\"nodes\": \\[", "\"nodes\": [99999, ", "node 99999 does not exist");
    expect("\"remeshing\",", "", "Add \"remeshing\" to /disable");
    expect("\"disable\": \\[\"proximity\",", "\"obstacles\": [{}], \"disable\": [", "contact with obstacles is not modelled");
    expect("\"motion\": 0", "\"motion\": 4", "motion 4 does not exist");
    expect("\"frame_time\": 0.4", "\"frame_time\": -1", "/frame_time");
    expect("meshes/strip.obj", "meshes/none.obj", "meshes/none.obj");
    const auto morph = [](const std::string& spline) {
        return "\"plasticity\"], \"morphs\": [{\"targets\": [\"meshes/sheet21.obj\"], \"spline\": [" + spline + "]}]";
    };
    const std::string key = "{\"time\": 0, \"target\": 0, \"stiffness\": 1}";
    expect("\"plasticity\"\\]", morph(""), "/morphs/0: a morph needs at least one key");
    expect("\"plasticity\"\\]", morph(key), "target 0 has 441 nodes, the cloth 231");
    expect("\"plasticity\"\\]", morph(key + ", " + key), "/morphs/0/spline/1/time");
    expect("\"plasticity\"\\]", morph("{\"time\": 0, \"target\": 3, \"stiffness\": 1}"), "target 3 does not exist");
}

TEST_CASE("clockwise faces are refused, an indefinite material stops the run with exit code 3") {
    const OutputFolder scratch("arcsim_failures");
    const fs::path& dir = scratch.path();
    const Result flip = run(changed_scene("fail_flip", dir, {}).string() + " " + (dir / "flip").string() + " --quiet", dir);
    CHECK(flip.code == 2);
    CHECK_THAT(flip.errors, Contains("runs clockwise in material space"));
    const Result indefinite = run(changed_scene("fail_nonpd", dir, {}).string() + " " + (dir / "nonpd").string() + " --quiet", dir);
    CHECK(indefinite.code == 3);
    CHECK_THAT(indefinite.errors, Contains("not positive definite") && Contains("k_uv"));
}

TEST_CASE("a pull beyond any cloth is never saved in silence: converged steps stop with exit code 3, the linearised one warns") {
    const OutputFolder scratch("arcsim_overstretch");
    const fs::path& dir = scratch.path();
    for (const std::string method : {"backward_euler", "newton_euler", "bdf2"})
        for (const std::string pull : {"-0.3", "-1e30", "-1e200"}) {
            const fs::path scene = changed_scene("strip_iso", dir, {{"-0.004", pull}, {"\"gravity\"", "\"solver\": {\"method\": \"" + method + "\"}, \"gravity\""},
                                                                    {"\"end_frame\": 5", "\"end_frame\": 2"}});
            const Result r = run(scene.string() + " " + (dir / "out").string() + " --quiet", dir);
            INFO(method << ' ' << pull << ' ' << r.errors);
            CHECK(r.code == (method == "backward_euler" && pull == "-0.3" ? 0 : 3));
            CHECK_THAT(r.errors, Contains("step ") && Contains("face ") && Contains("/solver/"));
        }
}

TEST_CASE("what is not modelled is left out when asked, and harmless keys are named once") {
    const OutputFolder scratch("arcsim_ignored");
    const fs::path& dir = scratch.path();
    const fs::path scene = changed_scene("strip_iso", dir, {{"\"end_frame\": 5", "\"end_frame\": 1, \"friction\": 0.3, \"save_every\": 2"},
                                                            {"\"remeshing\",", "\"remshing\","}});
    const Result refused = run(scene.string() + " " + (dir / "out").string() + " --quiet", dir);
    CHECK(refused.code == 2);
    const Result done = run(scene.string() + " " + (dir / "out").string() + " --quiet --ignore-unsupported", dir);
    CHECK(done.code == 0);
    CHECK_THAT(done.errors, Contains("/friction") && Contains("/save_every: is not a known key") && Contains("did you mean \"remeshing\"") && Contains("not ArcSim's"));
}
