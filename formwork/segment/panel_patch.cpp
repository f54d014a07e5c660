#include "formwork/segment/panel_patch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <queue>

namespace formwork {
namespace {

int find_root(std::vector<int>& parent, int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

int corner_of(const arcsim::Triangle& t, int node) {
    return t[0] == node ? 0 : t[1] == node ? 1 : 2;
}

double corner_angle_at(const Surface& s, const arcsim::Triangle& t, int k) {
    const Vector3d a = s.x[t[(k + 1) % 3]] - s.x[t[k]], b = s.x[t[(k + 2) % 3]] - s.x[t[k]];
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Marks local nodes where the number of borders that meet, or their kind, changes.
void find_junctions(const CutMesh& cut, PanelPatch& p) {
    // Borders at a node of the cut mesh, seen from this patch: each seam edge and rim edge of its faces. A node
    // where the patch's two borders are one seam and one rim, or where another seam leaves on the far side, is
    // a junction; the far side is looked at by walking round the node in the cut mesh.
    p.junction.assign(p.node.size(), 0);
    p.given.assign(p.node.size(), 0);
    for (int v = 0; v < p.surface.n_nodes(); ++v) {
        if (!p.topology.is_boundary_node(v)) continue;
        const int node = p.node[v];
        int seams = 0, rims = 0, given = 0;
        const int first = p.face[p.topology.node_faces[v].front()];
        int f = first;
        for (int turn = 0; turn < 2; ++turn) {   // counter-clockwise, then clockwise if a rim stopped us
            int steps = 0;
            do {
                const arcsim::Triangle& t = cut.surface().faces[f];
                const int k = corner_of(t, node);
                const int other = turn == 0 ? t[(k + 2) % 3] : t[(k + 1) % 3];
                const int next = turn == 0 ? cut.face_left(node, other) : cut.face_left(other, node);
                if (cut.is_seam(node, other)) ++seams, given += cut.is_given(node, other);
                if (next < 0) ++rims;
                f = next;
            } while (f >= 0 && f != first && ++steps < 1000);
            if (f == first) break;
            f = first;
        }
        p.given[v] = seams > 0 && given == seams;
        p.junction[v] = seams >= 3 || (seams >= 1 && rims >= 1) || seams == 1;
    }
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
            const arcsim::Triangle& t = s.faces[stack.back()];
            stack.pop_back();
            for (int k = 0; k < 3; ++k) {
                const int a = t[k], b = t[(k + 1) % 3], g = cut.face_left(b, a);
                if (g < 0 || panel[g] >= 0 || cut.is_seam(a, b)) continue;
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

PanelPatch extract_patch(const CutMesh& cut, const std::vector<int>& faces) {
    const Surface& s = cut.surface();
    PanelPatch p;
    p.face = faces;
    std::vector<int> local(s.faces.size(), -1);
    for (std::size_t i = 0; i < faces.size(); ++i) local[faces[i]] = static_cast<int>(i);
    std::vector<int> parent(3 * faces.size());   // corners, joined over inner edges that are no seams
    std::iota(parent.begin(), parent.end(), 0);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const arcsim::Triangle& t = s.faces[faces[i]];
        for (int k = 0; k < 3; ++k) {
            const int a = t[k], b = t[(k + 1) % 3];
            const int left = cut.face_left(b, a), there_face = left < 0 ? -1 : local[left];
            if (there_face < 0 || cut.is_seam(a, b)) continue;
            const arcsim::Triangle& u = s.faces[left];
            for (int end : {a, b}) {
                const int here = find_root(parent, 3 * static_cast<int>(i) + corner_of(t, end));
                const int there = find_root(parent, 3 * there_face + corner_of(u, end));
                parent[std::max(here, there)] = std::min(here, there);
            }
        }
    }
    std::vector<int> number(parent.size(), -1);
    p.surface.faces.resize(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const int root = find_root(parent, 3 * static_cast<int>(i) + k);
            if (number[root] < 0) {
                number[root] = p.surface.n_nodes();
                p.node.push_back(s.faces[faces[i]][k]);
                p.surface.x.push_back(s.x[p.node.back()]);
            }
            p.surface.faces[i][k] = number[root];
        }
    p.topology = arcsim::build_topology(p.surface, "panel");
    find_junctions(cut, p);
    return p;
}

double PanelPatch::border_length() const {
    double length = 0;
    for (const arcsim::Edge& e : topology.edges)
        if (e.is_boundary()) length += (surface.x[e.node[0]] - surface.x[e.node[1]]).norm();
    return length;
}

double boundary_angle(const PanelPatch& p, int node) {
    double angle = 0;
    for (int f : p.topology.node_faces[node])
        angle += corner_angle_at(p.surface, p.surface.faces[f], corner_of(p.surface.faces[f], node));
    return angle;
}

namespace {

double loop_length(const PanelPatch& p, const std::vector<int>& loop) {
    double length = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) length += (p.surface.x[loop[i]] - p.surface.x[loop[(i + 1) % loop.size()]]).norm();
    return length;
}

/// The point of an outline `arm` m away from its node i, onwards (step 1) or back (step -1).
Vector3d point_along(const PanelPatch& p, const std::vector<int>& loop, int i, int step, double arm) {
    const int n = static_cast<int>(loop.size());
    double left = arm;
    for (int j = i, count = 0; count < n; ++count) {
        const int k = (j + step + n) % n;
        const Vector3d &a = p.surface.x[loop[j]], &b = p.surface.x[loop[k]];
        const double l = (b - a).norm();
        if (l >= left) return a + left / l * (b - a);
        left -= l;
        j = k;
    }
    return p.surface.x[loop[i]];
}

/// By how much an outline turns within the surface from its mean course before node i to that after it, rad: nodes weigh by
/// nearness, and junctions, which are corners of their own, do not count.
double turn_along(const PanelPatch& p, const std::vector<int>& loop, int i, double arm) {
    const int n = static_cast<int>(loop.size());
    double turn = 0;
    for (int step : {1, -1}) {
        double gone = 0;
        for (int j = step > 0 ? i : (i - 1 + n) % n, last = i, count = 0; count < n; ++count, last = j, j = (j + step + n) % n) {
            gone += (p.surface.x[loop[j]] - p.surface.x[loop[last]]).norm();
            if (gone >= arm) break;
            if (!p.junction[loop[j]]) turn += (1 - gone / arm) * (std::numbers::pi - boundary_angle(p, loop[j]));
        }
    }
    return turn;
}

}  // namespace

std::vector<int> corner_nodes(const PanelPatch& p) {
    constexpr double turn = 40 * std::numbers::pi / 180;        // at junctions
    constexpr double rim_turn = 50 * std::numbers::pi / 180;    // elsewhere: the mesh's own zigzag must not count
    constexpr double arm_edges = 6, arm_share = 1. / 32;        // nor do the teeth of a ragged rim: seen over an arm's length, they cancel
    std::vector<int> corners;
    for (const auto& loop : p.topology.boundary_loops) {
        const int n = static_cast<int>(loop.size());
        const double length = loop_length(p, loop), arm = std::min(length * std::max(arm_edges / n, arm_share), length / 8);
        for (int i = 0; i < n; ++i) {
            const int v = loop[i];
            if (p.given[v] || std::abs(boundary_angle(p, v) - std::numbers::pi) <= (p.junction[v] ? turn : rim_turn)) continue;
            if (p.junction[v] || std::abs(turn_along(p, loop, i, arm)) > rim_turn) corners.push_back(v);
        }
    }
    return corners;
}

OutlineShape outline_shape(const PanelPatch& p, double reach) {
    constexpr double corner = 110 * std::numbers::pi / 180, inner = 230 * std::numbers::pi / 180;
    OutlineShape shape;
    for (const auto& loop : p.topology.boundary_loops) {
        const int n = static_cast<int>(loop.size());
        const double arm = std::min(reach, loop_length(p, loop) / 8);
        for (int i = 0; i < n; ++i) {
            const double angle = boundary_angle(p, loop[i]);
            if (angle > inner) ++shape.inner_corners;
            if (angle > corner) continue;
            const double gap = (point_along(p, loop, i, 1, arm) - point_along(p, loop, i, -1, arm)).norm();
            shape.sharpest = std::min({shape.sharpest, angle, 2 * std::asin(std::min(1., gap / (2 * arm)))});
        }
    }
    return shape;
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
