#include "arcsim/scene/run_scene.hpp"

#include <chrono>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "arcsim/scene/frame_files.hpp"

namespace arcsim {
namespace {

double wall_seconds() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// CPU seconds so far; the steps run in one thread, so that they pass for wall time.
double seconds_of_limits(const Simulation& simulation) {
    double sum = 0;
    for (const RunningCloth& cloth : simulation.cloths()) sum += cloth.stepper->cost().limits;
    return sum;
}

void run(const Scene& scene, Simulation& simulation, FrameFolder& folder, Progress& progress, RunStatus& status) {
    const SceneParams& p = scene.params;
    const double h = p.step();
    const double frames_by_time = p.last_time() / (h * p.steps_per_frame());
    const double n_frames = std::min({frames_by_time, p.end_frame, 9999.0});
    int frame = status.last_frame;
    double frame_start = wall_seconds(), limits_start = seconds_of_limits(simulation);
    const auto is_over = [&] { return simulation.time() >= p.last_time() || frame >= p.end_frame; };
    while (!is_over()) {
        ProgressState state;
        state.step = static_cast<int>(simulation.steps());
        state.fraction = simulation.time() / std::max(n_frames * h * p.steps_per_frame(), h);
        state.note = "frame " + std::to_string(frame) + ", t = " + format_short(simulation.time()) + " s";
        progress.update(state);
        simulation.step();
        status.steps = simulation.steps();
        status.time = simulation.time();
        if (const std::string warning = simulation.take_warning(); !warning.empty()) progress.warning(warning);
        if (simulation.steps() % p.steps_per_frame() != 0) continue;
        ++frame;
        folder.write_frame(frame, simulation);
        status.last_frame = frame;
        const double now = wall_seconds();
        const double limits = seconds_of_limits(simulation);
        folder.write_timing(now - frame_start - (limits - limits_start), limits - limits_start);
        frame_start = now;
        limits_start = limits;
    }
    progress.end(std::to_string(simulation.steps()) + " steps, " + format_short(simulation.time()) + " s simulated, " +
                 std::to_string(frame + 1) + " frames");
}

}  // namespace

void run_scene(const Scene& scene, const std::filesystem::path& folder, Progress& progress, RunStatus& status) {
    progress.begin("arcsim");
    Simulation simulation(scene.params, scene.motions, scene.morphs);   // before anything is written: the input may be wrong
    FrameFolder files(folder);
    files.begin(scene.text);
    files.write_frame(0, simulation);
    status.last_frame = 0;
    run(scene, simulation, files, progress, status);
}

void resume_scene(const Scene& scene, const std::filesystem::path& folder, int frame, Progress& progress,
                  RunStatus& status) {
    progress.begin("arcsim");
    Simulation simulation(scene.params, scene.motions, scene.morphs);
    FrameFolder files(folder);
    if (const std::string warning = files.load_frame(frame, scene.params, simulation); !warning.empty())
        progress.warning(warning);
    status = {frame, simulation.steps(), simulation.time()};
    run(scene, simulation, files, progress, status);
}

}  // namespace arcsim
