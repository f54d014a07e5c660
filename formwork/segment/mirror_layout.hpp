#pragma once

#include "formwork/segment/cut_mesh.hpp"
#include "formwork/segment/mirror_planes.hpp"

namespace formwork {

/// The surface with its nodes next to a plane moved onto it (along the surface; rim nodes along the rim), so
/// that a cut along the plane leaves no slivers and the halves' images do not overlap.
/// @param source  where each node lies on the input
Surface settle_on_plane(const Surface& s, const Topology& t, const Vector3d& point, const Vector3d& normal,
                        std::vector<SurfacePoint>& source);

/// Where a plane cuts the surface: closed curves, and curves from rim to rim.
std::vector<Curve> plane_curves(const Surface& s, const Topology& t, const Vector3d& point, const Vector3d& normal);

/// The faces kept and their mirror images, sewn together along the nodes they share with the faces left out:
/// the seams of one half drawn on the other as well. Mirrored nodes are put on the input surface.
struct MirroredMesh {
    Surface surface;
    std::vector<SurfacePoint> source;
    std::vector<int> source_face;
    std::vector<std::pair<int, int>> seams;
    std::vector<int> face_image;   // per face: its mirror image
    bool is_sound = false;         // no face is turned over and the area is the input's within 1 %
};

/// @param kept  per face of the cut mesh: 1 on the side that is mirrored
MirroredMesh mirror_half(const CutMesh& cut, const std::vector<char>& kept, const Surface& input, const Topology& t,
                         const MirrorPlane& plane);

}  // namespace formwork
