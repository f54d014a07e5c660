#include "formwork/segment/angle_transport.hpp"

#include <algorithm>
#include <cmath>

namespace formwork {

using std::numbers::pi;

int nearest_quarters(double angle) { return static_cast<int>(std::lround(angle / quarter_turn)); }

double wrap_quarter(double angle) { return angle - quarter_turn * std::round(angle / quarter_turn); }

double corner_angle(const Surface& s, int f, int k) {
    const arcsim::Triangle& t = s.faces[f];
    const arcsim::Vector3d a = s.x[t[(k + 1) % 3]] - s.x[t[k]], b = s.x[t[(k + 2) % 3]] - s.x[t[k]];
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

double edge_angle(const Surface& s, int f, int k) {
    if (k == 2) return 0;                                    // v0 -> v1
    if (k == 0) return pi - corner_angle(s, f, 1);           // v1 -> v2: turns left by pi - angle at v1
    return pi + corner_angle(s, f, 0);                       // v2 -> v0: against the ray at angle(v0)
}

std::vector<double> transport_angles(const Surface& s, const Topology& t) {
    std::vector<double> kappa(t.edges.size(), 0.0);
    for (std::size_t e = 0; e < t.edges.size(); ++e) {
        const arcsim::Edge& edge = t.edges[e];
        if (edge.is_boundary()) continue;
        // face[1] runs through the edge the other way: half a turn.
        const double here = edge_angle(s, edge.face[0], edge.corner[0]);
        const double there = edge_angle(s, edge.face[1], edge.corner[1]) + pi;
        kappa[e] = std::remainder(there - here, 2 * pi);
    }
    return kappa;
}

std::vector<double> angle_defects(const Surface& s, const Topology& t) {
    std::vector<double> defect(s.x.size(), 0.0);
    for (int v = 0; v < s.n_nodes(); ++v)
        if (!t.node_faces[v].empty()) defect[v] = t.is_boundary_node(v) ? pi : 2 * pi;
    for (int f = 0; f < s.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) defect[s.faces[f][k]] -= corner_angle(s, f, k);
    return defect;
}

std::vector<FanStep> fan_steps(const Surface& s, const Topology& t, int node) {
    const std::vector<int>& fan = t.node_faces[node];
    std::vector<FanStep> steps;
    const std::size_t n = t.is_boundary_node(node) ? fan.size() - 1 : fan.size();
    steps.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        const arcsim::Triangle& f = s.faces[fan[i]];
        const int e = t.face_edges[fan[i]][(arcsim::corner_of(f, node) + 1) % 3];   // counter-clockwise: over the edge opposite the next corner
        steps.push_back({e, t.edges[e].face[0] == fan[i] ? 1 : -1});
    }
    return steps;
}

}  // namespace formwork
