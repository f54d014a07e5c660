#pragma once

#include <string>
#include <vector>

#include "formwork/scene/bag_mesh.hpp"

namespace formwork {

/// What a careful look at a mesh file finds, whatever state it is in. Numbers in lines count vertices and
/// faces from 1, as OBJ files do.
struct MeshDiagnosis {
    std::vector<std::string> facts;      // size, counts, loops, angles: one line each
    std::vector<std::string> warnings;   // works, but look at it
    std::vector<std::string> faults;     // no stage can use the mesh: each with its remedy
    /// OBJ that shows the faulty places: their faces in groups, edges as lines; empty when there are none.
    std::string places_obj;
};

/// @param up  of the scene: the loop that is highest along it is "top"
MeshDiagnosis examine_mesh(const MeshFile& file, const BagMeshOptions& options, const arcsim::Vector3d& up);

}  // namespace formwork
