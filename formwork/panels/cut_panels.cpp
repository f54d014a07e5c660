#include "formwork/panels/cut_panels.hpp"

#include <cstdio>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "arcsim/base/error.hpp"

namespace formwork {
namespace {

using HalfEdge = std::pair<int, int>;   // nodes, in the direction of its face

/// Which copies of a node belong together: corners joined across every edge that is not cut.
class Corners {
public:
    explicit Corners(int n_faces) : parent_(3 * n_faces) { std::iota(parent_.begin(), parent_.end(), 0); }
    int find(int c) {
        while (parent_[c] != c) c = parent_[c] = parent_[parent_[c]];
        return c;
    }
    void join(int a, int b) { parent_[find(a)] = find(b); }

private:
    std::vector<int> parent_;
};

std::string edge_text(int a, int b) { return std::to_string(a) + "-" + std::to_string(b); }

std::set<HalfEdge> seam_edges(const Segmentation& s) {
    std::set<HalfEdge> cut;
    for (std::size_t i = 0; i < s.seams.size(); ++i)
        for (std::size_t k = 0; k + 1 < s.seams[i].nodes.size(); ++k) {
            const int a = s.seams[i].nodes[k], b = s.seams[i].nodes[k + 1];
            if (!cut.insert({std::min(a, b), std::max(a, b)}).second)
                throw arcsim::InputError("panels: edge " + edge_text(a, b) + " belongs to two seams, the second is seam " +
                                         std::to_string(i + 1) + ". List every seam edge once.");
        }
    return cut;
}

void check_disk(const FlatPanel& panel, const arcsim::Topology& t) {
    if (t.n_components == 1 && t.boundary_loops.size() == 1 && t.euler_characteristic() == 1) return;
    throw arcsim::InputError("panels: panel " + std::to_string(panel.id + 1) + " is no disk (" +
                             std::to_string(t.n_components) + " components, " + std::to_string(t.boundary_loops.size()) +
                             " boundary loops, Euler characteristic " + std::to_string(t.euler_characteristic()) +
                             ") and cannot be laid flat. Add a seam across it, or raise /formwork/segment/max_panels.");
}

}  // namespace

Surface panel_surface(const Segmentation& s, const FlatPanel& panel) {
    Surface surface;
    for (int node : panel.node) surface.x.push_back(s.mesh.x[node]);
    surface.faces = panel.faces;
    return surface;
}

void cut_panels(const Segmentation& s, PanelSet& set) {
    const arcsim::Topology topology = arcsim::build_topology(s.mesh, "segments");
    const std::set<HalfEdge> cut = seam_edges(s);
    Corners corners(s.mesh.n_faces());
    for (const arcsim::Edge& e : topology.edges) {
        if (cut.count({std::min(e.node[0], e.node[1]), std::max(e.node[0], e.node[1])})) continue;
        if (e.is_boundary() || s.panel[e.face[0]] != s.panel[e.face[1]])
            throw arcsim::InputError("panels: edge " + edge_text(e.node[0], e.node[1]) + " lies on the outline of panel " +
                                     std::to_string(s.panel[e.face[0]] + 1) +
                                     " but belongs to no seam and no rim. Run the segment stage again.");
        for (int end : {0, 1}) {   // face[1] runs through the edge backwards
            const int a = 3 * e.face[0] + (e.corner[0] + 1 + end) % 3, b = 3 * e.face[1] + (e.corner[1] + 2 - end) % 3;
            corners.join(a, b);
        }
    }

    set.panels.assign(s.n_panels, {});
    std::vector<int> local(3 * s.mesh.n_faces(), -1);   // of a corner's representative
    std::map<HalfEdge, std::pair<int, int>> half_edge;  // -> face, corner of its first node
    for (int f = 0; f < s.mesh.n_faces(); ++f) {
        if (s.panel[f] < 0 || s.panel[f] >= s.n_panels)
            throw arcsim::InputError("panels: face " + std::to_string(f) + " has panel number " + std::to_string(s.panel[f]) +
                                     ", expected 0 to " + std::to_string(s.n_panels - 1) + ".");
        FlatPanel& panel = set.panels[s.panel[f]];
        Triangle t;
        for (int k = 0; k < 3; ++k) {
            int& vertex = local[corners.find(3 * f + k)];
            if (vertex < 0) {
                vertex = static_cast<int>(panel.node.size());
                panel.node.push_back(s.mesh.faces[f][k]);
            }
            t[k] = vertex;
            half_edge[{s.mesh.faces[f][k], s.mesh.faces[f][(k + 1) % 3]}] = {f, k};
        }
        panel.face.push_back(f);
        panel.faces.push_back(t);
    }
    for (int p = 0; p < s.n_panels; ++p) {
        FlatPanel& panel = set.panels[p];
        panel.id = p;
        if (panel.faces.empty())
            throw arcsim::InputError("panels: panel " + std::to_string(p + 1) + " has no faces. Number panels without gaps.");
        const arcsim::Topology t = arcsim::build_topology(panel_surface(s, panel), "panel " + std::to_string(p + 1));
        check_disk(panel, t);
        panel.boundary = t.boundary_loops.front();
    }

    set.seams.clear();
    for (std::size_t i = 0; i < s.seams.size(); ++i) {
        const std::vector<int>& nodes = s.seams[i].nodes;
        PanelSeam seam;
        for (std::size_t k = 0; k + 1 < nodes.size(); ++k) seam.rest_length += (s.mesh.x[nodes[k + 1]] - s.mesh.x[nodes[k]]).norm();
        for (int side = 0; side < (s.seams[i].is_rim() ? 1 : 2); ++side) {
            SeamSide& chain = seam.side[side];
            chain.panel = s.seams[i].panel[side];
            for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
                const auto found = half_edge.find(side == 0 ? HalfEdge{nodes[k], nodes[k + 1]} : HalfEdge{nodes[k + 1], nodes[k]});
                if (found == half_edge.end() || s.panel[found->second.first] != chain.panel)
                    throw arcsim::InputError("panels: seam " + std::to_string(i + 1) + ": edge " + edge_text(nodes[k], nodes[k + 1]) +
                                             " does not lie on panel " + std::to_string(chain.panel + 1) +
                                             ", which the seam names. Run the segment stage again.");
                const auto [f, c] = found->second;
                const int first = local[corners.find(3 * f + c)], second = local[corners.find(3 * f + (c + 1) % 3)];
                if (k == 0) chain.vertex.push_back(side == 0 ? first : second);
                if (chain.vertex.back() != (side == 0 ? first : second))
                    throw arcsim::InputError("panels: seam " + std::to_string(i + 1) + " runs through node " + std::to_string(nodes[k]) +
                                             ", where another seam ends on the same panel. Split it there.");
                chain.vertex.push_back(side == 0 ? second : first);
            }
        }
        set.seams.push_back(std::move(seam));
    }
}

}  // namespace formwork
