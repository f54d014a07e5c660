#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "arcsim/mesh/cloth_mesh.hpp"

namespace formwork {

using arcsim::ClothMesh;
using arcsim::Surface;

/// A mesh as a designer's file holds it.
struct MeshFile {
    ClothMesh mesh;
    bool has_rest_coordinates = false;   // the file has `vt` (or `ms`) lines: verts mean something
};

/// Reads OBJ, PLY (ascii, little and big endian) or STL (ascii, binary), by the file's ending. STL corners
/// at exactly the same place become one node, since the format knows no sharing.
/// @throws InputError naming file and line (or byte): unknown format, broken numbers, indices out of range
MeshFile read_mesh_file(const std::filesystem::path& file);

Surface parse_ply(std::string_view bytes, const std::string& name);
Surface parse_stl(std::string_view bytes, const std::string& name);

/// Plain OBJ of a surface: positions and faces, a comment line at the top. Numbers to a tenth of a micrometre.
std::string format_plain_obj(const Surface& s, const std::string& comment);
/// The same with a flat rest shape (vt, m) and groups.
std::string format_plain_obj(const ClothMesh& m, const std::string& comment);

/// Makes one node of nodes that lie at exactly the same place at the ends of coinciding edges of single
/// faces, as in files that give every face its own corners. @returns how many nodes went away
int weld(ClothMesh& mesh);

/// A surface as a cloth mesh whose verts are the nodes' (x, y).
ClothMesh to_cloth_mesh(const Surface& s);

}  // namespace formwork
