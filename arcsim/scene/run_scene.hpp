#pragma once

#include <filesystem>

#include "arcsim/base/progress.hpp"
#include "arcsim/scene/read_scene.hpp"

namespace arcsim {

/// What a run has reached, also when it ends early.
struct RunStatus {
    int last_frame = -1;   // saved
    long steps = 0;
    double time = 0;       // s
};

/// Simulates a scene from the start and saves its frames, ArcSim's way: the end is tested after every step.
/// @throws NumericalError, Interrupted: `status` names the last saved frame
void run_scene(const Scene& scene, const std::filesystem::path& folder, Progress& progress, RunStatus& status);

/// Continues behind a saved frame, to the same digits as if the run had not stopped.
void resume_scene(const Scene& scene, const std::filesystem::path& folder, int frame, Progress& progress,
                  RunStatus& status);

}  // namespace arcsim
