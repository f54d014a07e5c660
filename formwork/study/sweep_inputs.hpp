#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace formwork {

/// A number that changes when the scene, a file that it names (meshes, materials) or one of `words` changes:
/// tells whether a point of a sweep that ran before is still the same. A file that cannot be read counts as
/// its name.
/// @param words  what else decides the result: overrides (whose values may name files too), stages
/// @throws InputError when the scene is no JSON
std::string fingerprint_inputs(const std::filesystem::path& scene, const std::vector<std::string>& words);

}  // namespace formwork
