#include "formwork/sew/stitches.hpp"

#include <map>
#include <numeric>

namespace formwork {
namespace {

/// Which corners of the faces around a node may share one node: those joined through edges that are not sewn.
class Fans {
public:
    explicit Fans(const Surface& mesh) : parent_(3 * mesh.faces.size()) { std::iota(parent_.begin(), parent_.end(), 0); }
    int root(int corner) {
        while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
        return corner;
    }
    void join(int a, int b) { parent_[root(a)] = root(b); }

private:
    std::vector<int> parent_;   // per corner 3 f + k
};

int corner_at(const Surface& mesh, int face, int node) {
    for (int k = 0; k < 3; ++k)
        if (mesh.faces[face][k] == node) return 3 * face + k;
    return -1;
}

}  // namespace

void split_into_stitches(const Segmentation& s, const SewParams& params, SewnBag& bag) {
    const Surface& mesh = s.mesh;
    std::map<std::pair<int, int>, int> face_of;
    for (int f = 0; f < mesh.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) face_of[{mesh.faces[f][k], mesh.faces[f][(k + 1) % 3]}] = f;
    std::map<std::pair<int, int>, int> sewn;   // undirected edge: its place in bag.edges
    for (size_t k = 0; k < bag.edges.size(); ++k) sewn[std::minmax(bag.edges[k].node[0], bag.edges[k].node[1])] = static_cast<int>(k);

    Fans fans(mesh);
    for (const auto& [edge, f] : face_of) {
        const auto other = face_of.find({edge.second, edge.first});
        if (other == face_of.end() || sewn.count(std::minmax(edge.first, edge.second))) continue;
        for (int node : {edge.first, edge.second}) fans.join(corner_at(mesh, f, node), corner_at(mesh, other->second, node));
    }
    // The first fan of a node keeps its number; the others get new nodes at the same place.
    std::map<int, int> node_of_fan;
    std::vector<char> taken(mesh.x.size(), 0);
    for (int f = 0; f < mesh.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int node = mesh.faces[f][k], fan = fans.root(3 * f + k);
            const bool held = bag.fixed[3 * node] && bag.fixed[3 * node + 1] && bag.fixed[3 * node + 2];
            if (!node_of_fan.count(fan)) {
                int own = node;
                if (taken[node] && !held) {
                    own = static_cast<int>(bag.cut.x.size());
                    bag.cut.x.push_back(mesh.x[node]);
                    bag.inflated.push_back(Vector3d(bag.inflated[node]));
                    bag.node_of_cut.push_back(node);
                    for (int axis = 0; axis < 3; ++axis) bag.fixed.push_back(bag.fixed[3 * node + axis]);
                }
                taken[node] = 1;
                node_of_fan[fan] = own;
            }
            bag.cut.faces[f][k] = node_of_fan[fan];
        }
    bag.springs.clear();
    const bool slack = params.thread_compression == ThreadCompression::slack;
    std::map<std::pair<int, int>, char> stitched;
    std::vector<SeamSpring> stitches;
    for (const SeamEdge& e : bag.edges) {
        std::array<std::array<int, 2>, 2> own;   // [side][end]
        for (int side = 0; side < 2; ++side)
            for (int end = 0; end < 2; ++end) {
                const int corner = corner_at(mesh, e.face[side], e.node[end]);
                own[side][end] = bag.cut.faces[e.face[side]][corner % 3];
            }
        for (int side = 0; side < 2; ++side) bag.springs.push_back({own[side][0], own[side][1], e.length, 0.5 * params.kappa(e.length), slack});
        for (int end = 0; end < 2; ++end) {
            const auto pair = std::minmax(own[0][end], own[1][end]);
            if (pair.first == pair.second || stitched.count(pair)) continue;
            stitched[pair] = 1;
            stitches.push_back({pair.first, pair.second, 0, params.stitch_stiffness});
        }
    }
    bag.n_stitches = static_cast<int>(stitches.size());
    bag.springs.insert(bag.springs.end(), stitches.begin(), stitches.end());
}

}  // namespace formwork
