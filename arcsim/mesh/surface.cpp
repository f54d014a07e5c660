#include "arcsim/mesh/surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace arcsim {

double total_area(const Surface& s) {
    double sum = 0;
    for (int f = 0; f < s.n_faces(); ++f) sum += face_area(s, f);
    return sum;
}

double mean_edge_length(const Surface& s) {
    double sum = 0;
    for (const Triangle& t : s.faces)
        for (int k = 0; k < 3; ++k) sum += (s.x[t[(k + 1) % 3]] - s.x[t[k]]).norm();
    return s.faces.empty() ? 0 : sum / (3.0 * s.n_faces());
}

double bounding_diagonal(const Surface& s) {
    if (s.x.empty()) return 0;
    Vector3d lo = s.x.front(), hi = s.x.front();
    for (const Vector3d& p : s.x) {
        lo = lo.cwiseMin(p);
        hi = hi.cwiseMax(p);
    }
    return (hi - lo).norm();
}

double min_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const auto angle = [](const Vector3d& p, const Vector3d& q) { return std::atan2(p.cross(q).norm(), p.dot(q)); };
    return std::min({angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)});
}

FaceFrame face_frame(const Surface& s, int f) {
    const Triangle& t = s.faces[f];
    FaceFrame frame;
    frame.n = face_normal(s, f);
    frame.e1 = (s.x[t[1]] - s.x[t[0]]).normalized();
    frame.e2 = frame.n.cross(frame.e1);
    return frame;
}

}  // namespace arcsim
