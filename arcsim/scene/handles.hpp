#pragma once

#include "arcsim/force/cloth_model.hpp"
#include "arcsim/mesh/cloth_mesh.hpp"
#include "arcsim/scene/motion.hpp"
#include "arcsim/scene/scene_params.hpp"

namespace arcsim {

/// The handles of one cloth as they run: which nodes, where they were taken hold of.
class Handles {
public:
    /// @throws InputError: nodes, labels or motions that do not exist
    Handles(const SceneParams& scene, int cloth, const ClothMesh& mesh, const std::vector<Motion>& motions);

    /// 1 from start to end, then (1 - (t - end) / fade)^4, else 0.
    static double strength(const HandleParams& p, double time);

    /// Puts springs and hard constraints of `model` where they are at `time`. A node handle that takes hold
    /// is anchored at `x`: its rest point is T(time)^-1 x.
    void update(double time, const VectorXd& x, ClothModel& model);

    std::vector<std::array<int, 2>> glued_pairs() const;

    /// Anchors by handle, for files; an empty list: not yet taken hold.
    std::vector<std::vector<Vector3d>> anchors() const;
    void set_anchors(const std::vector<std::vector<Vector3d>>& anchors);
    /// For frames of other programs, which do not tell: handles active at `time` are anchored at `x`.
    void anchor_at(double time, const VectorXd& x);

private:
    struct Handle {
        HandleParams params;
        std::vector<int> nodes;
        std::vector<Vector3d> anchors;     // node: rest points; circle: points before the motion
        std::vector<double> weights;       // circle: m of labelled edges; else 1
        bool is_anchored = false;
    };
    void set_up_circle(Handle& h, const ClothMesh& mesh);

    std::vector<Handle> handles_;
    const std::vector<Motion>& motions_;
    double stiffness_;
};

}  // namespace arcsim
