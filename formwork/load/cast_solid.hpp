#pragma once

#include <filesystem>

#include "arcsim/mesh/surface.hpp"

namespace formwork {

using arcsim::Surface;
using arcsim::Vector3d;

/// The cast as a watertight solid: the part of the bag below the liquid's level, closed by the level's plane. Where an
/// open rim lies below the level (a head over the rim), vertical walls lead up from it, as the load has it. Normals point
/// out of the liquid.
///
/// Triangles that the level crosses are cut exactly, so that the volume is the liquid's to rounding.
/// @param orientation  +1: the faces' normals already point out of the liquid; -1: into it
/// @throws arcsim::NumericalError: nothing lies below the level
Surface cast_solid(const Surface& bag, const Vector3d& up, double level, int orientation);

/// Volume inside a closed surface, m³ (divergence theorem).
double enclosed_volume(const Surface& closed);

/// Edges whose two directions do not occur equally often: 0 for a watertight surface.
int open_edges(const Surface& s);

/// Binary STL, coordinates as they are (m). @throws arcsim::InputError: the file cannot be written
void write_stl(const std::filesystem::path& file, const Surface& s, const std::string& name);

}  // namespace formwork
