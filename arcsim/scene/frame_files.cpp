#include "arcsim/scene/frame_files.hpp"

#include <cstdio>
#include <fstream>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "arcsim/base/json_reader.hpp"
#include "arcsim/base/text.hpp"
#include "arcsim/mesh/obj_io.hpp"

namespace arcsim {
namespace {

std::string numbered(int frame, const char* format) {
    char text[32];
    std::snprintf(text, sizeof text, format, frame);
    return text;
}

template <class List>
JsonValue numbers(const List& list) {
    JsonValue a = JsonValue::array();
    for (double v : list) a.add(JsonValue(v));
    return a;
}

std::vector<double> read_numbers(const JsonNode& node, int n) {
    if (node.size() != n) node.fail("expected " + std::to_string(n) + " numbers, got " + node.shown() + ".");
    std::vector<double> r(n);
    for (int i = 0; i < n; ++i) r[i] = node[i].number();
    return r;
}

JsonValue resume_state(const RunningCloth& cloth) {
    JsonValue v = JsonValue::object();
    v.set("lagged_x", numbers(cloth.lagged_x));
    v.set("lagged_angles", numbers(cloth.model.bend->lagged_angles()));
    JsonValue anchors = JsonValue::array();
    for (const auto& handle : cloth.handles->anchors()) {
        std::vector<double> flat;
        for (const Vector3d& p : handle) flat.insert(flat.end(), p.begin(), p.end());
        anchors.add(numbers(flat));
    }
    v.set("anchors", std::move(anchors));
    v.set("memory", numbers(cloth.stepper->memory()));
    return v;
}

void restore(const JsonNode& node, RunningCloth& cloth) {
    const auto x = read_numbers(node.at("lagged_x"), static_cast<int>(cloth.state.x.size()));
    cloth.lagged_x = Eigen::Map<const VectorXd>(x.data(), cloth.state.x.size());
    cloth.model.refresh(cloth.lagged_x);
    cloth.model.bend->set_lagged_angles(
        read_numbers(node.at("lagged_angles"), static_cast<int>(cloth.model.bend->hinges().size())));
    std::vector<std::vector<Vector3d>> anchors;
    for (int i = 0; i < node.at("anchors").size(); ++i) {
        const JsonNode list = node.at("anchors")[i];
        const auto flat = read_numbers(list, list.size());
        anchors.emplace_back();
        for (size_t k = 0; k + 2 < flat.size(); k += 3) anchors.back().emplace_back(flat[k], flat[k + 1], flat[k + 2]);
    }
    cloth.handles->set_anchors(anchors);
    const JsonNode memory = node.at("memory");
    cloth.stepper->set_memory(read_numbers(memory, memory.size()));
}

ClothMesh read_frame(const std::filesystem::path& file, const RunningCloth& cloth) {
    if (!std::filesystem::exists(file))
        throw InputError(file.string() + ": there is no such frame. Name the folder and a frame that a run has saved.");
    ClothMesh frame = read_obj(file);
    if (frame.n_nodes() != cloth.mesh.n_nodes())
        throw InputError(file.string() + ": has " + std::to_string(frame.n_nodes()) + " nodes, the scene's mesh " +
                         std::to_string(cloth.mesh.n_nodes()) + ". Resume with the scene that made the frame.");
    return frame;
}

}  // namespace

std::filesystem::path FrameFolder::frame_file(int frame, int cloth) const {
    return folder_ / (numbered(frame, "%04d") + numbered(cloth, "_%02d.obj"));
}
std::filesystem::path FrameFolder::resume_file(int frame) const {
    return folder_ / "resume" / numbered(frame, "%04d.json");
}

void FrameFolder::begin(const std::string& scene_text) {
    write_file_atomically(folder_ / "conf.json", scene_text);
    write_file_atomically(folder_ / "timing", "");
}

void FrameFolder::write_frame(int frame, const Simulation& simulation) {
    constexpr int last_saved = 9999;   // ArcSim's names have four digits
    if (frame > last_saved) return;
    JsonValue state = JsonValue::object();
    state.set("time", simulation.time());
    state.set("step", static_cast<double>(simulation.steps()));
    JsonValue cloths = JsonValue::array();
    for (size_t c = 0; c < simulation.cloths().size(); ++c) {
        const RunningCloth& cloth = simulation.cloths()[c];
        write_obj(frame_file(frame, static_cast<int>(c)), cloth.frame());
        cloths.add(resume_state(cloth));
    }
    state.set("cloths", std::move(cloths));
    write_file_atomically(resume_file(frame), to_text_one_line(state) + "\n");
}

void FrameFolder::write_timing(double physics, double strain_limiting) {
    std::ofstream out(folder_ / "timing", std::ios::app);
    out << "0 " << format_short(physics, 6) << ' ' << format_short(strain_limiting, 6) << " 0 0 0 0 0\n";
}

std::string FrameFolder::load_frame(int frame, const SceneParams& scene, Simulation& simulation) const {
    auto& cloths = simulation.cloths();
    if (std::filesystem::exists(resume_file(frame))) {
        for (size_t c = 0; c < cloths.size(); ++c) cloths[c].set_frame(read_frame(frame_file(frame, static_cast<int>(c)), cloths[c]));
        const JsonDocument document = read_json(resume_file(frame));
        const JsonNode root(document), states = root.at("cloths");
        if (states.size() != static_cast<int>(cloths.size())) states.fail("does not belong to this scene: another number of cloths.");
        simulation.set_time(root.at("time").number(), static_cast<long>(root.at("step").number()));
        for (size_t c = 0; c < cloths.size(); ++c) restore(states[static_cast<int>(c)], cloths[c]);
        return {};
    }
    const long steps = static_cast<long>(frame) * scene.steps_per_frame();
    double time = 0;
    for (long i = 0; i < steps; ++i) time += scene.step();   // the same rounding as a run
    simulation.set_time(time, steps);
    for (size_t c = 0; c < cloths.size(); ++c) {
        RunningCloth& cloth = cloths[c];
        cloth.set_frame(read_frame(frame_file(frame, static_cast<int>(c)), cloth));
        cloth.lagged_x = cloth.state.x - scene.step() * cloth.state.v;
        cloth.model.refresh(cloth.lagged_x);
        cloth.handles->anchor_at(time, cloth.state.x);
    }
    return "no " + resume_file(frame).string() + ": lagged quantities and handle anchors are reconstructed from the frame's digits.";
}

}  // namespace arcsim
