#pragma once

#include <vector>

#include "arcsim/base/json_reader.hpp"
#include "arcsim/force/cloth_model.hpp"

namespace arcsim {

/// When a morph is which target, and how stiffly.
struct MorphKey {
    double time = 0;        // s
    int target = 0;
    double stiffness = 0;   // N/m per node, > 0
};

void visit(Archive& a, MorphKey& k);

/// Springs from every node of a cloth to a shape that changes in time. Shapes are interpolated between keys by the
/// cubic of motions (see Motion), stiffnesses by the same cubic of their logarithms; both are held outside.
/// ArcSim's format names the log space; its weights between the keys are not known. Target files hold positions in
/// the world: the cloth's transform is not applied.
struct Morph {
    int cloth = 0;
    std::vector<VectorXd> targets;   // 3n, m
    std::vector<MorphKey> keys;      // ascending times

    /// Stiffness at `time`; `shape` becomes the target.
    double at(double time, VectorXd& shape) const;
    /// Adds the springs of `time`.
    void add_springs(double time, std::vector<SpringForce::Target>& springs) const;
};

/// `morphs` of a scene: an array of {cloth, targets: [file, ...], spline: [{time, target, stiffness}, ...]}.
/// @throws InputError: wrong types, times that do not increase, targets that do not exist
std::vector<Morph> read_morphs(const JsonNode& node, Warnings& warnings);

}  // namespace arcsim
