#include "formwork/segment/panel_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>

namespace formwork {
namespace {

double corner_angle_at(const Surface& s, const arcsim::Triangle& t, int k) {
    const Vector3d a = s.x[t[(k + 1) % 3]] - s.x[t[k]], b = s.x[t[(k + 2) % 3]] - s.x[t[k]];
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

std::vector<int> label_panels(const CutMesh& cut, int& n_panels) {
    const Surface& s = cut.surface();
    std::vector<int> panel(s.faces.size(), -1), stack;
    n_panels = 0;
    for (int seed = 0; seed < s.n_faces(); ++seed) {
        if (panel[seed] >= 0) continue;
        panel[seed] = n_panels;
        stack.assign(1, seed);
        while (!stack.empty()) {
            const int f = stack.back();
            stack.pop_back();
            for (int k = 0; k < 3; ++k) {
                const int g = cut.across(f, k);
                if (g < 0 || panel[g] >= 0 || cut.is_seam_at(f, k)) continue;
                panel[g] = n_panels;
                stack.push_back(g);
            }
        }
        ++n_panels;
    }
    return panel;
}

std::vector<std::vector<int>> panel_faces(const std::vector<int>& panel, int n_panels) {
    std::vector<std::vector<int>> faces(n_panels);
    for (std::size_t f = 0; f < panel.size(); ++f) faces[panel[f]].push_back(static_cast<int>(f));
    return faces;
}

double PanelPatch::border_length() const {
    double length = 0;
    for (const arcsim::Edge& e : topology.edges)
        if (e.is_boundary()) length += (surface.x[e.node[0]] - surface.x[e.node[1]]).norm();
    return length;
}

double angle_sum(const PanelPatch& p, int node) {
    double angle = 0;
    for (int f : p.topology.node_faces[node])
        angle += corner_angle_at(p.surface, p.surface.faces[f], arcsim::corner_of(p.surface.faces[f], node));
    return angle;
}

EdgeLengths::EdgeLengths(const PanelPatch& p) : start_(p.surface.x.size() + 1, 0), arcs_(2 * p.topology.edges.size()) {
    for (const arcsim::Edge& e : p.topology.edges)
        for (int v : e.node) ++start_[v + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    std::vector<int> fill(start_.begin(), start_.end() - 1);
    for (const arcsim::Edge& e : p.topology.edges) {
        const double l = (p.surface.x[e.node[0]] - p.surface.x[e.node[1]]).norm();
        arcs_[fill[e.node[0]]++] = {e.node[1], l};
        arcs_[fill[e.node[1]]++] = {e.node[0], l};
    }
}

double patch_width(const PanelPatch& p) {
    const EdgeLengths graph(p);
    using Item = std::pair<double, int>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    std::vector<double> distance(p.surface.n_nodes(), std::numeric_limits<double>::infinity());
    for (int v = 0; v < p.surface.n_nodes(); ++v)
        if (p.topology.is_boundary_node(v)) queue.emplace(distance[v] = 0, v);
    double widest = 0;
    while (!queue.empty()) {
        const auto [d, v] = queue.top();
        queue.pop();
        if (d > distance[v]) continue;
        widest = std::max(widest, d);
        for (const auto& [w, l] : graph.around(v))
            if (d + l < distance[w]) queue.emplace(distance[w] = d + l, w);
    }
    return 2 * widest;
}

}  // namespace formwork
