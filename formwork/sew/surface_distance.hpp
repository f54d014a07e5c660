#pragma once

#include <array>
#include <vector>

#include "arcsim/mesh/surface.hpp"

namespace formwork {

using arcsim::Surface;
using arcsim::Triangle;
using arcsim::Vector3d;

/// Closest points on a triangle surface, by a tree of bounding boxes.
class SurfaceDistance {
public:
    /// @throws InputError: no faces
    explicit SurfaceDistance(const Surface& surface);

    struct Closest {
        Vector3d point;      // m
        int face = -1;
        double signed_distance = 0;   // m; positive on the side that the normals point to
    };
    Closest closest(const Vector3d& q) const;

private:
    struct Box {
        Vector3d low, high;
        int first = 0, count = 0;   // count > 0: a leaf with faces order_[first ..]
        int right = 0;              // the left child follows its parent
    };
    int build(int first, int count);
    void search(int box, const Vector3d& q, double& best, Vector3d& point, int& face) const;
    Vector3d pseudonormal(int face, const Vector3d& point) const;

    const Surface surface_;
    std::vector<Vector3d> node_normal_;                  // angle-weighted
    std::vector<std::array<Vector3d, 3>> edge_normal_;   // per face, of the edge opposite each corner
    std::vector<int> order_;
    std::vector<Box> boxes_;
};

/// The point of a triangle closest to q.
Vector3d closest_on_triangle(const Vector3d& q, const Vector3d& a, const Vector3d& b, const Vector3d& c);

/// How far a deformed surface lies from another one.
struct Deviation {
    std::vector<double> per_node;   // signed, m; positive outside
    double rms = 0, max = 0;        // m; rms weighted by the deformed surface's area
    int worst_node = -1;
};
Deviation deviation(const Surface& from, const SurfaceDistance& to);

}  // namespace formwork
