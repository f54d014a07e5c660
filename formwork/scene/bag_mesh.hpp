#pragma once

#include <array>
#include <string>
#include <vector>

#include "arcsim/base/archive.hpp"
#include "arcsim/mesh/cloth_mesh.hpp"
#include "arcsim/mesh/topology.hpp"
#include "formwork/fabric/flat_triangle.hpp"
#include "formwork/mesher/mesh_file.hpp"

namespace formwork {

/// Length unit of a mesh file.
enum class LengthUnit { m, cm, mm, in };
inline constexpr std::array length_unit_names{
    arcsim::EnumName{LengthUnit::m, "m"}, arcsim::EnumName{LengthUnit::cm, "cm"},
    arcsim::EnumName{LengthUnit::mm, "mm"}, arcsim::EnumName{LengthUnit::in, "in"}};
double metres_per(LengthUnit unit);

/// Where the unstretched shape of the fabric comes from.
enum class RestFrom {
    automatic,   // vt when it is there and could be rest coordinates, else the mesh in space
    vt,          // the file's vt, which must be rest coordinates
    mesh         // the mesh in space, each face in its own plane
};
inline constexpr std::array rest_from_names{
    arcsim::EnumName{RestFrom::automatic, "auto", "vt when every edge is about as long there as in space, else the mesh"},
    arcsim::EnumName{RestFrom::vt, "vt", "the file's vt are flat rest coordinates"},
    arcsim::EnumName{RestFrom::mesh, "mesh", "the mesh in space is unstretched"}};

/// The bag as the stages need it: metres, welded, manifold, consistently oriented, without stray nodes.
struct BagMesh {
    ClothMesh cloth;                    // as in the file, in metres
    Surface surface;                    // its nodes and faces
    arcsim::Topology topology;
    std::vector<FlatTriangle> flat;     // rest coordinates per face, m; empty: each face in its own plane
    int stray_vertices = 0;             // of the file, that belong to no face and were left out
    std::vector<std::string> notes;     // what was done to the file: welded, dropped, taken as rest shape
};

struct BagMeshOptions {
    LengthUnit unit = LengthUnit::m;
    RestFrom rest = RestFrom::automatic;
    bool weld_nodes = true;
    bool any_size = false;              // no complaint about a bag of 1 mm or 1 km
};

/// What is said of vertices that were joined with others at their places, and of those that no face uses: the
/// mesh's examination and the stages say the same.
std::string welded_note(int vertices);
std::string stray_note(int vertices);

/// Brings a mesh file into shape for the stages.
/// @throws InputError, one line naming the file, the vertex or face (counted from 1, as in OBJ) and the
///         remedy: no faces, not a number, a face without area, non-manifold, flipped faces, a size that can
///         only be a wrong unit, vt that cannot be rest coordinates although they were asked for
BagMesh prepare_bag_mesh(MeshFile file, const std::string& name, const BagMeshOptions& options);

}  // namespace formwork
