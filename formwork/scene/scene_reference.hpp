#pragma once

#include <string>

namespace formwork {

/// docs/scene.md: every key of a scene file as Markdown tables with type, range, default, unit and meaning, from the
/// same visits that read the file.
std::string scene_reference_text();

}  // namespace formwork
