#include "formwork/segment/crease_seams.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "formwork/segment/panel_patch.hpp"

namespace formwork {
namespace {

using Edges = std::set<std::pair<int, int>>;

Edges bent_edges(const Surface& s, const Topology& t, double angle) {
    Edges edges;
    for (const arcsim::Edge& e : t.edges)
        if (!e.is_boundary() && arcsim::bend_angle(s, e) > angle)
            edges.insert(std::minmax(e.node[0], e.node[1]));
    return edges;
}

/// Edges that part nothing go: from every end that lies neither on the rim nor on another crease.
void drop_loose_ends(const Topology& t, Edges& edges) {
    for (bool changed = true; changed;) {
        changed = false;
        std::map<int, int> degree;
        for (const auto& [a, b] : edges) ++degree[a], ++degree[b];
        std::erase_if(edges, [&](const auto& e) {
            const bool loose = (degree[e.first] == 1 && !t.is_boundary_node(e.first)) || (degree[e.second] == 1 && !t.is_boundary_node(e.second));
            changed |= loose;
            return loose;
        });
    }
}

}  // namespace

bool mark_crease_seams(CutMesh& cut, double angle, double min_width) {
    const Surface& s = cut.surface();
    const Topology t = arcsim::build_topology(s, "segment");
    Edges edges = bent_edges(s, t, angle);
    for (bool changed = true; changed;) {   // the narrowest pieces join the neighbour with the longest border
        changed = false;
        drop_loose_ends(t, edges);
        for (const auto& [a, b] : edges) cut.mark_seam(a, b);
        int n = 0;
        const std::vector<int> piece = label_panels(cut, n);
        const auto faces = panel_faces(piece, n);
        std::map<int, std::map<int, double>> border;   // of a narrow piece: neighbour -> m
        for (int p = 0; p < n; ++p)
            if (patch_width(extract_patch(cut, faces[p])) < min_width) border[p];
        for (const arcsim::Edge& e : t.edges)
            for (int side = 0; side < 2 && !e.is_boundary(); ++side) {
                const int p = piece[e.face[side]], q = piece[e.face[1 - side]];
                if (p != q && border.count(p)) border[p][q] += (s.x[e.node[0]] - s.x[e.node[1]]).norm();
            }
        std::set<std::pair<int, int>> joined;
        for (const auto& [p, lengths] : border) {
            const auto longest = std::max_element(lengths.begin(), lengths.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
            if (longest != lengths.end()) joined.insert(std::minmax(p, longest->first));
        }
        for (const auto& [a, b] : edges) cut.unmark_seam(a, b);
        for (const arcsim::Edge& e : t.edges)
            if (!e.is_boundary() && joined.count(std::minmax(piece[e.face[0]], piece[e.face[1]])))
                changed |= edges.erase(std::minmax(e.node[0], e.node[1])) > 0;
    }
    for (const auto& [a, b] : edges) cut.mark_seam(a, b);
    return !edges.empty();
}

}  // namespace formwork
