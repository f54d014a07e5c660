#pragma once

#include <filesystem>
#include <string>

#include "arcsim/scene/simulation.hpp"

namespace arcsim {

/// ArcSim's folder of frames: conf.json, FFFF_CC.obj for frame F and cloth C, timing with one line per
/// frame. Ours beside them: resume/FFFF.json, what a frame's OBJ cannot hold and the next step needs.
class FrameFolder {
public:
    explicit FrameFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// conf.json, byte for byte, and an empty timing file.
    void begin(const std::string& scene_text);
    void write_frame(int frame, const Simulation& simulation);
    /// Wall seconds of a frame in ArcSim's eight modules; only physics and strain limiting do work here.
    void write_timing(double physics, double strain_limiting);

    std::filesystem::path frame_file(int frame, int cloth) const;
    std::filesystem::path resume_file(int frame) const;

    /// Puts a fresh simulation where `frame` left off. With our resume file to the same digits; from a
    /// folder of ArcSim's, which keeps six digits, lagged quantities and anchors are reconstructed.
    /// @returns a warning when reconstructed, else empty  @throws InputError: no such frame, another mesh
    std::string load_frame(int frame, const SceneParams& scene, Simulation& simulation) const;

private:
    std::filesystem::path folder_;
};

}  // namespace arcsim
