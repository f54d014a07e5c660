#pragma once

#include <string>

#include "formwork/scene/formwork_scene.hpp"

namespace formwork {

/// The scene of `formwork init`: few keys in use, every other key of the `formwork` object in a comment with its default, unit and
/// meaning, all from the table that reads the file.
std::string starter_scene_text();

/// A woven fabric in ArcSim's format for it.
std::string starter_material_text();

}  // namespace formwork
