#pragma once

#include "arcsim/force/cloth_model.hpp"
#include "arcsim/mesh/cloth_mesh.hpp"
#include "arcsim/scene/scene_params.hpp"

namespace arcsim {

/// The mesh of a cloth where its `transform` and `velocity` put it: positions, velocities, and material
/// coordinates times the scale. `ny` stays as in the file, as ArcSim writes it.
/// @throws InputError: unreadable mesh
ClothMesh place_mesh(const ClothParams& cloth);

/// Forces and masses of a placed mesh.
/// @throws InputError naming mesh file and face or node: clockwise faces in material space, labels without
///         material, edges of three faces, faces that disagree about their side
ClothModel build_model(const ClothMesh& mesh, const ClothParams& cloth, const SceneParams& scene);

}  // namespace arcsim
