#include <algorithm>
#include <limits>

#include "formwork/segment/mesh_repair.hpp"

namespace formwork {
namespace {

/// Nearest point of one triangle, barycentric: the plane's point when inside, else the nearest of its sides.
std::array<double, 3> nearest_in_face(const Surface& s, int f, const Vector3d& x) {
    const std::array<double, 3> inside = barycentric_coordinates(s, f, x);
    if (*std::min_element(inside.begin(), inside.end()) >= 0) return inside;
    std::array<double, 3> best{1, 0, 0};
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const Vector3d &a = s.x[s.faces[f][k]], &b = s.x[s.faces[f][(k + 1) % 3]];
        const double t = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0., 1.);
        const double d = (a + t * (b - a) - x).squaredNorm();
        if (d < least) {
            least = d;
            best = {0, 0, 0};
            best[k] = 1 - t;
            best[(k + 1) % 3] = t;
        }
    }
    return best;
}

}  // namespace

Vector3d point_at(const Surface& input, const SurfacePoint& p) {
    Vector3d x = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) x += p.barycentric[k] * input.x[input.faces[p.face][k]];
    return x;
}

SurfacePoint nearest_point(const Surface& input, const Topology& t, int start, const Vector3d& x) {
    SurfacePoint best{start, nearest_in_face(input, start, x)};
    double least = (point_at(input, best) - x).squaredNorm();
    for (int step = 0; step < 20; ++step) {   // to the best face around, until none is better
        const int from = best.face;
        for (int v : input.faces[from])
            for (int f : t.node_faces[v]) {
                if (f == best.face) continue;
                const SurfacePoint p{f, nearest_in_face(input, f, x)};
                const double d = (point_at(input, p) - x).squaredNorm();
                if (d < least - 1e-18) {
                    least = d;
                    best = p;
                }
            }
        if (best.face == from) break;
    }
    return best;
}

}  // namespace formwork
