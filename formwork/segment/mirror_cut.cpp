#include <algorithm>
#include <cmath>
#include <limits>

#include "formwork/segment/mesh_repair.hpp"
#include "formwork/segment/mirror_layout.hpp"

namespace formwork {

void settle_on_plane(MeshOnInput& mesh, const Topology& t, const MirrorPlane& plane, const Surface& input, const Topology& input_topology) {
    constexpr double reach = 0.25;   // of a node's shortest edge
    const Surface s = mesh.surface;
    std::vector<double> height, shortest(s.x.size(), std::numeric_limits<double>::infinity());
    for (const Vector3d& x : s.x) height.push_back(plane.normal.dot(x - plane.point));
    for (const arcsim::Edge& e : t.edges)
        for (int v : e.node) shortest[v] = std::min(shortest[v], (s.x[e.node[0]] - s.x[e.node[1]]).norm());
    const auto is_near = [&](int v) { return std::abs(height[v]) < reach * shortest[v]; };
    const auto move = [&](int v, const Vector3d& x) {
        mesh.source[v] = nearest_point(input, input_topology, mesh.source[v].face, x);
        mesh.surface.x[v] = point_at(input, mesh.source[v]);
    };
    for (int v = 0; v < s.n_nodes(); ++v)
        if (is_near(v) && !t.is_boundary_node(v)) move(v, s.x[v] - height[v] * plane.normal);
    for (const arcsim::Edge& e : t.edges) {
        if (!e.is_boundary() || height[e.node[0]] * height[e.node[1]] >= 0) continue;
        const int end = is_near(e.node[0]) ? 0 : is_near(e.node[1]) ? 1 : -1;
        if (end < 0) continue;
        const double u = height[e.node[0]] / (height[e.node[0]] - height[e.node[1]]);
        move(e.node[end], (1 - u) * s.x[e.node[0]] + u * s.x[e.node[1]]);
    }
}

std::vector<Curve> plane_curves(const Surface& s, const Topology& t, const MirrorPlane& plane) {
    std::vector<double> height;
    const double on_plane = 0.02 * arcsim::mean_edge_length(s);   // settled nodes, but for the surface's curvature
    for (const Vector3d& x : s.x) {
        height.push_back(plane.normal.dot(x - plane.point));
        if (std::abs(height.back()) < on_plane) height.back() = 0;
    }
    const auto crossed = [&](int e) {
        return (height[t.edges[e].node[0]] >= 0) != (height[t.edges[e].node[1]] >= 0);
    };
    const auto point_on = [&](int e) {
        const auto [a, b] = t.edges[e].node;
        return CurvePoint{a, b, std::abs(height[a]) / (std::abs(height[a]) + std::abs(height[b]))};
    };
    std::vector<char> done(t.edges.size(), 0);
    const auto follow = [&](int first) {   // every face that is cut has two crossed edges
        Curve curve{point_on(first)};
        done[first] = 1;
        int e = first, f = t.edges[first].face[0];
        while (f >= 0) {
            int next = -1;
            for (int g : t.face_edges[f])
                if (g != e && crossed(g)) next = g;
            if (next < 0) break;
            curve.push_back(point_on(next));
            if (next == first || done[next]) break;
            done[next] = 1;
            f = t.edges[next].face[0] == f ? t.edges[next].face[1] : t.edges[next].face[0];
            e = next;
        }
        return curve;
    };
    std::vector<Curve> curves;
    for (int open = 1; open >= 0; --open)   // those that begin at a rim first
        for (std::size_t e = 0; e < t.edges.size(); ++e)
            if (!done[e] && crossed(static_cast<int>(e)) && (!open || t.edges[e].is_boundary()))
                curves.push_back(follow(static_cast<int>(e)));
    return curves;
}

}  // namespace formwork
