#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "arcsim/base/types.hpp"

namespace arcsim {

/// A triangle surface in space: the plain currency between stages.
struct Surface {
    std::vector<Vector3d> x;       // nodes, m
    std::vector<Triangle> faces;   // node indices

    int n_nodes() const { return static_cast<int>(x.size()); }
    int n_faces() const { return static_cast<int>(faces.size()); }
};

/// Area vector of a face: half the cross product of two edges; its length is the area, m². A Triangle may be one that the
/// surface does not have (yet).
inline Vector3d area_vector(const Surface& s, const Triangle& t) {
    return 0.5 * (s.x[t[1]] - s.x[t[0]]).cross(s.x[t[2]] - s.x[t[0]]);
}
inline Vector3d area_vector(const Surface& s, int f) { return area_vector(s, s.faces[f]); }

inline double face_area(const Surface& s, int f) { return area_vector(s, f).norm(); }
inline Vector3d face_normal(const Surface& s, const Triangle& t) { return area_vector(s, t).normalized(); }
inline Vector3d face_normal(const Surface& s, int f) { return face_normal(s, s.faces[f]); }
inline Vector3d face_centroid(const Surface& s, int f) {
    const Triangle& t = s.faces[f];
    return (s.x[t[0]] + s.x[t[1]] + s.x[t[2]]) / 3;
}

double total_area(const Surface& s);
double mean_edge_length(const Surface& s);
double bounding_diagonal(const Surface& s);

/// Smallest interior angle of a triangle, radians; 0 for a degenerate one.
double min_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c);
inline double min_angle(const Surface& s, const Triangle& t) { return min_angle(s.x[t[0]], s.x[t[1]], s.x[t[2]]); }
inline double min_angle(const Surface& s, int f) { return min_angle(s, s.faces[f]); }

/// The tangent frame that every per-face angle of this project refers to: first axis along the edge from
/// corner 0 to corner 1, second axis 90° counter-clockwise about the face's normal.
struct FaceFrame {
    Vector3d e1, e2, n;
    Vector3d direction(double theta) const { return std::cos(theta) * e1 + std::sin(theta) * e2; }
    double angle(const Vector3d& d) const { return std::atan2(d.dot(e2), d.dot(e1)); }
    Vector2d local(const Vector3d& d) const { return {d.dot(e1), d.dot(e2)}; }
};
FaceFrame face_frame(const Surface& s, int f);

}  // namespace arcsim
