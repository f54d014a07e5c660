#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "arcsim/mesh/cloth_mesh.hpp"

namespace arcsim {

/// Reads an OBJ file in ArcSim's dialect; plain OBJ files of designers are a subset.
///
///   vt vl | v ny nv nl | e ea ed el | f (n, n/v, n/v/k, n//k) tl fl ts fs td fd | g o
///
/// Faces name the node first, the vert second. Polygons are cut into a fan from the corner that gives the
/// largest smallest angle in space; a label after a polygon belongs to all of its triangles. A corner
/// without vert takes the node's first vert, or a new one at the node's (x, y). Negative indices count
/// from the end. Other keywords are ignored. `ms x y z` (ArcSim 0.3) is read as `vt` when z is 0.
/// @throws InputError naming file and line
ClothMesh read_obj(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
ClothMesh parse_obj(std::string_view text, const std::string& name);

/// The file's text in ArcSim's order of fields: all verts, all nodes, edges with an angle or a label, faces
/// as n/v. Numbers have the fewest digits that read back to the same double. Each `g` group is named before
/// its faces.
std::string format_obj(const ClothMesh& mesh);

/// Writes atomically: the file is either the old one or complete.
/// @throws InputError when the file cannot be written
void write_obj(const std::filesystem::path& file, const ClothMesh& mesh);

}  // namespace arcsim
