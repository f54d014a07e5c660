#include "formwork/segment/mirror_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "formwork/segment/mesh_repair.hpp"
#include "formwork/segment/nearest_surface.hpp"

namespace formwork {

Surface settle_on_plane(const Surface& s, const Topology& t, const Vector3d& point, const Vector3d& normal,
                        std::vector<SurfacePoint>& source) {
    constexpr double reach = 0.25;   // of a node's shortest edge
    Surface moved = s;
    source = CutMesh(s).source();
    std::vector<double> height, shortest(s.x.size(), std::numeric_limits<double>::infinity());
    for (const Vector3d& x : s.x) height.push_back(normal.dot(x - point));
    for (const arcsim::Edge& e : t.edges)
        for (int v : e.node) shortest[v] = std::min(shortest[v], (s.x[e.node[0]] - s.x[e.node[1]]).norm());
    const auto is_near = [&](int v) { return std::abs(height[v]) < reach * shortest[v]; };
    for (int v = 0; v < s.n_nodes(); ++v) {
        if (!is_near(v) || t.is_boundary_node(v)) continue;
        source[v] = nearest_point(s, t, source[v].face, s.x[v] - height[v] * normal);
        moved.x[v] = point_at(s, source[v]);
    }
    for (const arcsim::Edge& e : t.edges) {
        if (!e.is_boundary() || height[e.node[0]] * height[e.node[1]] >= 0) continue;
        const int end = is_near(e.node[0]) ? 0 : is_near(e.node[1]) ? 1 : -1;
        if (end < 0) continue;
        const double u = height[e.node[0]] / (height[e.node[0]] - height[e.node[1]]);
        SurfacePoint p{e.face[0], {0, 0, 0}};
        p.barycentric[(e.corner[0] + 1) % 3] = 1 - u;
        p.barycentric[(e.corner[0] + 2) % 3] = u;
        source[e.node[end]] = p;
        moved.x[e.node[end]] = point_at(s, p);
    }
    return moved;
}

std::vector<Curve> plane_curves(const Surface& s, const Topology& t, const Vector3d& point, const Vector3d& normal) {
    std::vector<double> height;
    const double on_plane = 0.02 * arcsim::mean_edge_length(s);   // settled nodes, but for the surface's curvature
    for (const Vector3d& x : s.x) {
        height.push_back(normal.dot(x - point));
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

MirroredMesh mirror_half(const CutMesh& cut, const std::vector<char>& kept, const Surface& input, const Topology& t,
                         const MirrorPlane& plane) {
    const Surface& s = cut.surface();
    std::vector<char> in_half(s.x.size(), 0), shared(s.x.size(), 0), on_rim(s.x.size(), 0);
    for (int f = 0; f < s.n_faces(); ++f)
        for (int k = 0; k < 3; ++k)
            if (kept[f]) in_half[s.faces[f][k]] = 1;
    for (int f = 0; f < s.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = s.faces[f][k], b = s.faces[f][(k + 1) % 3];
            if (!kept[f] && in_half[a]) shared[a] = 1;
            if (cut.face_left(b, a) < 0) on_rim[a] = on_rim[b] = 1;
        }
    const NearestSurface nearest(input, t);
    const auto on_input = [&](int v) {
        const Vector3d x = plane.mirror(s.x[v]);
        const NearestSurface::Hit hit = nearest.point(x);
        SurfacePoint p = nearest_point(input, t, hit.face, x);
        if (!on_rim[v]) return p;
        double least = 1e300;   // the nearest point of the rim
        for (const arcsim::Edge& e : t.edges) {
            if (!e.is_boundary()) continue;
            const Vector3d a = input.x[e.node[0]], d = input.x[e.node[1]] - a;
            const double u = std::clamp((x - a).dot(d) / d.squaredNorm(), 0., 1.), off = (a + u * d - x).squaredNorm();
            if (off >= least) continue;
            least = off;
            p.face = e.face[0];
            p.barycentric = {0, 0, 0};
            p.barycentric[(e.corner[0] + 1) % 3] = 1 - u;
            p.barycentric[(e.corner[0] + 2) % 3] = u;
        }
        return p;
    };
    MirroredMesh m;
    std::vector<std::array<int, 2>> number(s.x.size(), {-1, -1});
    const auto add = [&](const Vector3d& x, const SurfacePoint& p) {
        m.surface.x.push_back(x);
        m.source.push_back(p);
        return m.surface.n_nodes() - 1;
    };
    for (int v = 0; v < s.n_nodes(); ++v)
        if (in_half[v]) number[v][0] = number[v][1] = add(s.x[v], cut.source()[v]);
    for (int v = 0; v < s.n_nodes(); ++v)
        if (in_half[v] && !shared[v]) {
            const SurfacePoint p = on_input(v);
            number[v][1] = add(point_at(input, p), p);
        }
    for (int side = 0; side < 2; ++side)
        for (int f = 0; f < s.n_faces(); ++f) {
            if (!kept[f]) continue;
            arcsim::Triangle u;
            for (int k = 0; k < 3; ++k) u[k] = number[s.faces[f][k]][side];
            if (side == 1) std::swap(u[1], u[2]);
            m.surface.faces.push_back(u);
        }
    const int half = m.surface.n_faces() / 2;
    for (int f = 0; f < 2 * half; ++f) m.face_image.push_back(f < half ? f + half : f - half);
    m.is_sound = std::abs(arcsim::total_area(m.surface) / arcsim::total_area(input) - 1) < 0.01;
    for (int f = 0; f < s.n_faces(); ++f)
        if (kept[f]) m.source_face.push_back(cut.source_face()[f]);
    for (int f = half; f < 2 * half; ++f) {
        const Vector3d c = arcsim::face_centroid(m.surface, f);
        const arcsim::Triangle& u = m.surface.faces[f];
        m.source_face.push_back(nearest_point(input, t, m.source[u[0]].face, c).face);
        const Vector3d n = arcsim::area_vector(m.surface, f);
        if (n.dot(arcsim::face_normal(input, m.source_face.back())) < 0.3 * n.norm()) m.is_sound = false;
    }
    std::set<std::pair<int, int>> seams;
    for (int f = 0; f < s.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = s.faces[f][k], b = s.faces[f][(k + 1) % 3];
            if (!kept[f] || !cut.is_seam(a, b)) continue;
            for (int side = 0; side < 2; ++side) seams.insert(std::minmax(number[a][side], number[b][side]));
        }
    m.seams.assign(seams.begin(), seams.end());
    return m;
}

}  // namespace formwork
