#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "formwork/report/paint.hpp"
#include "formwork/report/render_surface.hpp"

namespace formwork {

/// A coloured surface with lines as binary glTF 2.0 (.glb), metres, turned so that `up` becomes
/// glTF's +y. Colours are vertex colours in linear light, as the format asks; both sides of the
/// cloth are shown.
/// @throws std::invalid_argument  colours do not fit (our own error)      @throws
/// arcsim::InputError  cannot write
void write_glb(const std::filesystem::path& path, const Surface& surface, const Paint& paint,
               const std::vector<Line3>& lines, const Vector3d& up, const std::string& name);

}  // namespace formwork
