#pragma once

#include <vector>

#include "arcsim/base/types.hpp"
#include "arcsim/mesh/surface.hpp"
#include "arcsim/mesh/topology.hpp"

namespace formwork {

using arcsim::Surface;
using arcsim::Topology;

/// A plane in which the surface mirrors onto itself.
struct MirrorPlane {
    arcsim::Vector3d point;     // on the plane, m
    arcsim::Vector3d normal;    // unit; its largest component is positive
    double deviation = 0;       // largest distance of a mirrored node from the surface, m
    std::vector<int> mate;      // per node: the node nearest to its mirror image
    bool exact = false;         // the mates pair up and lie where the images lie: the mesh itself mirrors

    arcsim::Vector3d mirror(const arcsim::Vector3d& x) const { return x - 2 * normal.dot(x - point) * normal; }
};

struct MirrorParams {
    double tolerance = 0.005;   // of the bounding diagonal: a mirrored node may miss the surface by that
    int max_planes = 4;         // a surface of revolution has any number
};

/// Mirror planes of the surface (not of the mesh: the triangles need not match), best first; among equally
/// good ones those that lie along the coordinate axes, then those at right angles to the ones before.
/// Every such plane passes through the centre of area and its normal is a principal axis of inertia; where
/// axes are not unique, normals in between are tried and refined by closest points.
std::vector<MirrorPlane> find_mirror_planes(const Surface& s, const Topology& t, const MirrorParams& params = {});

}  // namespace formwork
