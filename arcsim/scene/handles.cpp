#include "arcsim/scene/handles.hpp"

#include <cmath>
#include <numbers>
#include <set>

#include "arcsim/base/error.hpp"

namespace arcsim {
namespace {

std::string name_of(size_t handle) { return "/handles/" + std::to_string(handle) + ": "; }

Pose pose_at(const std::vector<Motion>& motions, int motion, double time) {
    return motion < 0 ? Pose{} : motions[motion].pose(time);
}

}  // namespace

Handles::Handles(const SceneParams& scene, int cloth, const ClothMesh& mesh, const std::vector<Motion>& motions)
    : motions_(motions), stiffness_(scene.magic.handle_stiffness) {
    for (size_t i = 0; i < scene.handles.size(); ++i) {
        const HandleParams& p = scene.handles[i];
        const int n_cloths = static_cast<int>(scene.cloths.size()), n_motions = static_cast<int>(motions.size());
        if (p.cloth >= n_cloths)
            throw InputError(name_of(i) + "cloth " + std::to_string(p.cloth) + " does not exist; there are " +
                             std::to_string(n_cloths) + ", counted from 0.");
        if (p.motion >= n_motions)
            throw InputError(name_of(i) + "motion " + std::to_string(p.motion) + " does not exist; there are " +
                             std::to_string(n_motions) + ", counted from 0.");
        if (p.cloth != cloth) continue;
        Handle h{p, {}, {}, {}, false};
        if (p.type != HandleType::glue && p.label >= 0) {
            for (int n = 0; n < mesh.n_nodes(); ++n)
                if (mesh.node_label[n] == p.label) h.nodes.push_back(n);
            if (h.nodes.empty())
                throw InputError(name_of(i) + "no node of the mesh has the label " + std::to_string(p.label) + " (nl lines).");
        } else {
            h.nodes = p.nodes;
        }
        for (int n : h.nodes)
            if (n >= mesh.n_nodes())
                throw InputError(name_of(i) + "node " + std::to_string(n) + " does not exist; the mesh has " +
                                 std::to_string(mesh.n_nodes()) + ", counted from 0.");
        h.weights.assign(h.nodes.size(), 1);
        if (p.type == HandleType::circle) set_up_circle(h, mesh);
        handles_.push_back(std::move(h));
    }
}

void Handles::set_up_circle(Handle& h, const ClothMesh& mesh) {
    const HandleParams& p = h.params;
    const double radius = p.circumference / (2 * std::numbers::pi);
    std::vector<double> length(mesh.n_nodes(), 0);
    std::vector<int> vert(mesh.n_nodes(), -1);
    std::set<std::pair<int, int>> labelled, seen;
    for (const EdgeRecord& e : mesh.edges)
        if (e.label == p.label) labelled.insert(std::minmax(e.node[0], e.node[1]));
    // The circle's edges are those with its label (el lines); in a mesh without any, those between labelled nodes.
    const auto is_on_circle = [&](int a, int b) {
        if (!labelled.empty()) return labelled.contains(std::minmax(a, b));
        return mesh.node_label[a] == p.label && mesh.node_label[b] == p.label;
    };
    for (int f = 0; f < mesh.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.face_nodes[f][k], b = mesh.face_nodes[f][(k + 1) % 3];
            if (vert[a] < 0) vert[a] = mesh.face_verts[f][k];
            if (!is_on_circle(a, b)) continue;
            if (!seen.insert(std::minmax(a, b)).second) continue;
            const double l = (mesh.u[mesh.face_verts[f][k]] - mesh.u[mesh.face_verts[f][(k + 1) % 3]]).norm();
            length[a] += l;
            length[b] += l;
        }
    for (size_t k = 0; k < h.nodes.size(); ++k) {
        const int n = h.nodes[k];
        const double angle = vert[n] < 0 ? 0 : 2 * std::numbers::pi * p.u.dot(mesh.u[vert[n]]) / p.circumference;
        h.anchors.push_back(p.center + radius * (std::cos(angle) * p.axis0 + std::sin(angle) * p.axis1));
        h.weights[k] = length[n];
    }
    h.is_anchored = true;
}

double Handles::strength(const HandleParams& p, double time) {
    if (time < p.start_time) return 0;
    if (time <= p.end_time) return 1;
    if (time >= p.end_time + p.fade_time) return 0;
    return std::pow(1 - (time - p.end_time) / p.fade_time, 4);
}

void Handles::anchor_at(double time, const VectorXd& x) {
    for (Handle& h : handles_) {
        if (h.is_anchored || h.params.type != HandleType::node || strength(h.params, time) <= 0) continue;
        const Pose pose = pose_at(motions_, h.params.motion, time);
        if (pose.scale == 0)
            throw InputError("a handle takes hold at t = " + std::to_string(time) +
                             " s, when its motion has scale 0: no rest point leads to its nodes. Start the motion with another scale.");
        h.anchors.clear();
        for (int n : h.nodes) h.anchors.push_back(pose.apply_inverse(x.segment<3>(3 * n)));
        h.is_anchored = true;
    }
}

void Handles::update(double time, const VectorXd& x, ClothModel& model) {
    anchor_at(time, x);
    auto& targets = model.springs.targets();
    auto& pairs = model.springs.pairs();
    targets.clear();
    pairs.clear();
    model.held.clear();
    for (const Handle& h : handles_) {
        const double s = strength(h.params, time);
        if (s <= 0) continue;
        if (h.params.type == HandleType::glue) {
            pairs.push_back({h.nodes[0], h.nodes[1], s * stiffness_});
            continue;
        }
        const Pose pose = pose_at(motions_, h.params.motion, time);
        for (size_t k = 0; k < h.nodes.size(); ++k) {
            const Vector3d goal = pose.apply(h.anchors[k]);
            if (h.params.hard && s == 1)
                model.held.push_back({h.nodes[k], goal});
            else
                targets.push_back({h.nodes[k], s * stiffness_ * h.weights[k], goal});
        }
    }
}

std::vector<std::array<int, 2>> Handles::glued_pairs() const {
    std::vector<std::array<int, 2>> pairs;
    for (const Handle& h : handles_)
        if (h.params.type == HandleType::glue) pairs.push_back({h.nodes[0], h.nodes[1]});
    return pairs;
}

std::vector<std::vector<Vector3d>> Handles::anchors() const {
    std::vector<std::vector<Vector3d>> r;
    for (const Handle& h : handles_) r.push_back(h.is_anchored ? h.anchors : std::vector<Vector3d>{});
    return r;
}

void Handles::set_anchors(const std::vector<std::vector<Vector3d>>& anchors) {
    for (size_t i = 0; i < handles_.size() && i < anchors.size(); ++i) {
        if (anchors[i].size() != handles_[i].nodes.size() || anchors[i].empty()) continue;
        handles_[i].anchors = anchors[i];
        handles_[i].is_anchored = true;
    }
}

}  // namespace arcsim
