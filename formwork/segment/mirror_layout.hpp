#pragma once

#include "formwork/segment/cut_mesh.hpp"
#include "formwork/segment/mirror_planes.hpp"

namespace formwork {

/// A mesh on the input surface.
struct MeshOnInput {
    Surface surface;
    std::vector<SurfacePoint> source;   // per node
    std::vector<int> source_face;       // per face
};

/// Moves the nodes next to a plane onto it (along the surface; rim nodes along the rim), so that a cut along the plane
/// leaves no slivers and the halves' images do not overlap.
void settle_on_plane(MeshOnInput& mesh, const Topology& t, const MirrorPlane& plane, const Surface& input, const Topology& input_topology);

/// Where a plane cuts the surface: closed curves, and curves from rim to rim.
std::vector<Curve> plane_curves(const Surface& s, const Topology& t, const MirrorPlane& plane);

/// The part of a cut mesh on the positive side of all planes, and then its mirror images one by one, sewn together along
/// the planes: the seams of one part drawn on the others as well. Mirrored nodes are put on the input surface.
struct MirroredMesh {
    MeshOnInput mesh;
    std::vector<std::pair<int, int>> seams;
    std::vector<std::vector<int>> face_image;   // per plane, per face: its mirror image
    bool is_sound = false;                      // no face is turned over and the area is the input's within 1 %
};

/// @param planes   one, or two at right angles
/// @param is_kept  per face of the cut mesh: 1 in the part that is mirrored
MirroredMesh mirror_part(const CutMesh& cut, const std::vector<char>& is_kept, const Surface& input, const Topology& t,
                         const std::vector<MirrorPlane>& planes);

}  // namespace formwork
