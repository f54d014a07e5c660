#pragma once

#include <vector>

#include "formwork/segment/cut_mesh.hpp"

namespace formwork {

/// The cut mesh after repair: as a Segmentation holds it.
struct RepairedMesh {
    Surface surface;
    std::vector<SurfacePoint> source;
    std::vector<int> source_face;
    std::vector<std::pair<int, int>> seams;   // edges
    std::vector<char> given;                  // per seam edge: it was asked for
    std::vector<int> node;                    // per node of the cut mesh: where it is now; -1: gone
};

/// Straightens the seams and mends thin triangles that cutting left: nodes slide along their seam, thin faces
/// are flipped, collapsed or relaxed. Every node stays on the input surface (moved ones are put back on it by
/// nearest point), seams stay connected as they are, and the input's own nodes and the rim are not removed.
/// @param fixed  nodes that must neither move nor vanish, besides layout nodes and the rim
RepairedMesh repair_mesh(const CutMesh& cut, const Surface& input, const Topology& input_topology,
                         const std::vector<int>& fixed);

/// The point of the input surface nearest to x, looked for from face `start` outwards, a few faces at most.
SurfacePoint nearest_point(const Surface& input, const Topology& t, int start, const Vector3d& x);
Vector3d point_at(const Surface& input, const SurfacePoint& p);

}  // namespace formwork
