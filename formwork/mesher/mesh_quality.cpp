#include "formwork/mesher/mesh_quality.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace formwork {

MeshQuality measure_quality(const arcsim::Surface& s) {
    MeshQuality q;
    q.min_angle_deg = 180;
    q.min_edge = std::numeric_limits<double>::infinity();
    constexpr double degrees = 180 / std::numbers::pi;
    for (int f = 0; f < s.n_faces(); ++f) {
        double smallest = 180;
        for (int k = 0; k < 3; ++k) {
            const arcsim::Vector3d a = s.x[s.faces[f][(k + 1) % 3]] - s.x[s.faces[f][k]];
            const arcsim::Vector3d b = s.x[s.faces[f][(k + 2) % 3]] - s.x[s.faces[f][k]];
            const double angle = degrees * std::atan2(a.cross(b).norm(), a.dot(b));
            smallest = std::min(smallest, angle);
            q.max_angle_deg = std::max(q.max_angle_deg, angle);
            const double length = a.norm();
            q.min_edge = std::min(q.min_edge, length);
            q.max_edge = std::max(q.max_edge, length);
            q.mean_edge += length / (3.0 * s.n_faces());
        }
        if (smallest < q.min_angle_deg) q.min_angle_deg = smallest, q.worst_face = f;
        q.n_below_20 += smallest < 20;
        q.n_below_5 += smallest < 5;
    }
    if (s.n_faces() == 0) q.min_angle_deg = q.min_edge = 0;
    return q;
}

}  // namespace formwork
