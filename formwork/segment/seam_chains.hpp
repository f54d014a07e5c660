#pragma once

#include "formwork/segment/cut_mesh.hpp"

namespace formwork {

/// Seams and rims of a cut mesh as chains between layout nodes: nodes where the number of borders is not two, where
/// a seam and the rim meet, or where the pair of panels changes. Chains without any such node are closed.
/// Ordered by their lowest edge. @param panel  per face
std::vector<Seam> collect_seams(const CutMesh& cut, const std::vector<int>& panel);

}  // namespace formwork
