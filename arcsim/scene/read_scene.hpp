#pragma once

#include "arcsim/scene/scene_params.hpp"
#include "arcsim/base/json_reader.hpp"
#include "arcsim/scene/morph.hpp"
#include "arcsim/scene/motion.hpp"

namespace arcsim {

/// A scene as read: keys, motions, morphs, and what to tell the user.
struct Scene {
    SceneParams params;
    std::vector<Motion> motions;
    std::vector<Morph> morphs;
    std::string text;          // of the file, byte by byte
    Warnings warnings;
};

/// Reads a plain cloth scene. Files it names are looked up beside it first, then in the working directory.
/// @throws InputError: wrong or unknown keys; what would change the result and is not modelled, unless
///         `unsupported` is warn
Scene read_scene(const std::filesystem::path& file, Unsupported unsupported = Unsupported::error);

/// Refuses what the scene needs and nobody here does: contact with obstacles, remeshing, plasticity.
/// Self-contact is only warned about: whether a scene needs it cannot be known.
void check_modelled(const SceneParams& scene, const std::string& source, Unsupported unsupported, Warnings& warnings);

}  // namespace arcsim
