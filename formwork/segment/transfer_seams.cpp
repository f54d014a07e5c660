#include <algorithm>
#include <queue>

#include "formwork/segment/search_mesh.hpp"
#include "formwork/segment/mesh_repair.hpp"
#include "formwork/segment/panel_patch.hpp"

namespace formwork {
namespace {

/// Face of the coarse mesh under every node of the input: walked from node to node, so that sheets that touch
/// each other are not taken for one another.
std::vector<int> coarse_faces(const Surface& coarse, const Topology& coarse_topology, const std::vector<SurfacePoint>& source,
                              const Surface& input, const Topology& t) {
    std::vector<int> face(input.x.size(), -1);
    std::queue<int> queue;
    for (int v = 0; v < coarse.n_nodes(); ++v) {
        if (coarse_topology.node_faces[v].empty()) continue;
        const auto& b = source[v].barycentric;
        const int near = input.faces[source[v].face][std::max_element(b.begin(), b.end()) - b.begin()];
        if (face[near] >= 0) continue;
        face[near] = nearest_point(coarse, coarse_topology, coarse_topology.node_faces[v].front(), input.x[near]).face;
        queue.push(near);
    }
    while (!queue.empty()) {
        const int v = queue.front();
        queue.pop();
        for (int f : t.node_faces[v])
            for (int w : input.faces[f]) {
                if (face[w] >= 0) continue;
                face[w] = nearest_point(coarse, coarse_topology, face[v], input.x[w]).face;
                queue.push(w);
            }
    }
    return face;
}

/// Islands of a panel go to the panel around them.
void drop_islands(const Surface& s, const Topology& t, std::vector<int>& label) {
    std::vector<int> piece(s.x.size(), -1), stack;
    std::vector<std::vector<int>> pieces;
    const auto each_neighbour = [&](int v, auto&& body) {
        for (int f : t.node_faces[v])
            for (int w : s.faces[f])
                if (w != v) body(w);
    };
    for (int seed = 0; seed < s.n_nodes(); ++seed) {
        if (piece[seed] >= 0) continue;
        const int id = static_cast<int>(pieces.size());
        pieces.emplace_back();
        piece[seed] = id;
        stack.assign(1, seed);
        while (!stack.empty()) {
            const int v = stack.back();
            stack.pop_back();
            pieces[id].push_back(v);
            each_neighbour(v, [&](int w) {
                if (piece[w] >= 0 || label[w] != label[seed]) return;
                piece[w] = id;
                stack.push_back(w);
            });
        }
    }
    std::vector<std::size_t> largest(*std::max_element(label.begin(), label.end()) + 1, 0);
    for (const auto& p : pieces) largest[label[p[0]]] = std::max(largest[label[p[0]]], p.size());
    for (const auto& p : pieces) {
        if (p.size() == largest[label[p[0]]]) continue;
        std::vector<int> votes(largest.size(), 0);
        for (int v : p)
            each_neighbour(v, [&](int w) { votes[label[w]] += label[w] != label[v]; });
        const int winner = static_cast<int>(std::max_element(votes.begin(), votes.end()) - votes.begin());
        for (int v : p) label[v] = winner;
    }
}

}  // namespace

std::optional<CutMesh> transfer_seams(const CutMesh& coarse, const std::vector<int>& panel, int n, const Surface& input,
                                      const Topology& t) {
    const Surface& c = coarse.surface();
    for (int f = 0; f < c.n_faces(); ++f)   // a slit has one panel on both sides: no label tells of it
        for (int k = 0; k < 3; ++k) {
            const int g = coarse.across(f, k);
            if (g >= 0 && panel[f] == panel[g] && coarse.is_seam_at(f, k)) return {};
        }
    const Topology coarse_topology = arcsim::build_topology(c, "segment");
    const std::vector<int> face = coarse_faces(c, coarse_topology, coarse.source(), input, t);
    std::vector<int> label(input.x.size());
    for (std::size_t v = 0; v < face.size(); ++v) label[v] = panel[face[v]];
    drop_islands(input, t, label);

    CutMesh cut(input);
    for (const arcsim::Edge& e : t.edges) {
        const auto [a, b] = e.node;
        if (label[a] == label[b]) continue;
        double low = 0, high = 1;   // the panel of a ends between
        int at = face[a];
        for (int step = 0; step < 7; ++step) {
            const double middle = 0.5 * (low + high);
            const int here = nearest_point(c, coarse_topology, at, (1 - middle) * input.x[a] + middle * input.x[b]).face;
            if (panel[here] == label[a]) {
                low = middle;
                at = here;
            } else {
                high = middle;
            }
        }
        constexpr double margin = 0.1;   // of the edge: no thinner faces than repair can mend
        cut.split_edge(a, b, std::clamp(0.5 * (low + high), margin, 1 - margin));
    }
    // Every face keeps at least one node of the input, and that tells its panel.
    const Surface& s = cut.surface();
    std::vector<int> of_face;
    for (const arcsim::Triangle& f : s.faces) of_face.push_back(label[*std::min_element(f.begin(), f.end())]);
    for (int f = 0; f < s.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int i = s.faces[f][k], j = s.faces[f][(k + 1) % 3], g = cut.across(f, k);
            if (g > f && of_face[f] != of_face[g]) cut.mark_seam(i, j);
        }
    int found = 0;
    const std::vector<int> walked = label_panels(cut, found);
    if (found != n) return {};
    for (const auto& faces : panel_faces(walked, found))
        if (!extract_patch(cut, faces).is_disk()) return {};
    return cut;
}

}  // namespace formwork
