#pragma once

#include <optional>
#include <vector>

#include "formwork/segment/cut_mesh.hpp"

namespace formwork {

/// A coarser mesh of the same surface, on which a layout is searched.
struct SearchMesh {
    Surface surface;
    std::vector<SurfacePoint> source;   // per node: where it lies on the input
    std::vector<int> source_face;       // per face: the input face under its centroid
};

/// Draws edges together, shortest first, until about `target` faces are left, then evens the mesh out by flips and
/// tangential steps; every node stays on the input. The rim and folds (dihedral above 40°) keep their course,
/// and no face turns away from the surface under it: where the surface bends strongly, more faces remain.
SearchMesh search_mesh(const Surface& input, const Topology& t, int target);

/// The seams of a layout on the coarse mesh, cut into the input: its nodes take the panel of the place that they lie on,
/// its edges are split where the panel changes, its faces along the lines between.
/// @param panel  per face of `coarse`
/// @param n      number of panels
/// @returns nothing when the panels do not come out as they were: one missing, or in two pieces
std::optional<CutMesh> transfer_seams(const CutMesh& coarse, const std::vector<int>& panel, int n, const Surface& input,
                                      const Topology& t);

}  // namespace formwork
