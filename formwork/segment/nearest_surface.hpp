#pragma once

#include <vector>

#include "arcsim/mesh/surface.hpp"
#include "arcsim/mesh/topology.hpp"

namespace formwork {

using arcsim::Surface;
using arcsim::Topology;
using arcsim::Vector3d;

/// The point of the triangle a, b, c that is nearest to p.
Vector3d nearest_in_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c);

/// Nodes in a grid of cells: which is nearest to a point, and how far the surface is.
class NearestSurface {
public:
    NearestSurface(const Surface& s, const Topology& t);

    /// Nearest node; ties go to the lower number.
    int node(const Vector3d& p) const;

    struct Hit {
        int face;
        Vector3d x;
        double distance;
    };
    /// Nearest point on the faces about the few nearest nodes: exact for points closer to the surface than an
    /// edge's length, an upper bound beyond.
    Hit point(const Vector3d& p) const;

private:
    int cell_of(double x, int axis) const;
    template <class Body>
    void visit_cells(const Vector3d& p, int ring, Body&& body) const;

    const Surface& s_;
    const Topology& t_;
    Vector3d low_;
    double size_ = 1;
    std::array<int, 3> count_{};
    std::vector<int> start_, nodes_;   // cell -> nodes_
};

}  // namespace formwork
