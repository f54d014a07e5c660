#pragma once

#include "formwork/scene/bag_mesh.hpp"
#include "formwork/sew/sewn_bag.hpp"
#include "formwork/stages/stage.hpp"

namespace formwork {

/// What a sewn bag is made of beside its panels: from the scene, and from the files of the stage `inflate`.
struct SewData {
    BagMesh mesh;
    std::vector<char> held;           // degrees of freedom of the mesh
    std::vector<Vector3d> inflated;   // its nodes
    std::optional<double> inflated_level, inflated_volume;

    /// All of it must outlive the input.
    SewInput input(const FormworkScene& scene, const Segmentation& cut, const std::vector<FlatPanel>& panels) const;
};

/// @throws InputError  inflate/inflated.obj is missing, or belongs to another mesh
SewData read_sew_data(const StageContext& context);

}  // namespace formwork
