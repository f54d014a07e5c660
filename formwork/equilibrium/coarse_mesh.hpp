#pragma once

#include <vector>

#include "arcsim/mesh/surface.hpp"

namespace formwork {

/// A mesh of fewer nodes on the same surface: its nodes are some of the fine ones.
struct CoarseMesh {
    arcsim::Surface surface;
    std::vector<int> fine_node;   // per coarse node
    std::vector<int> fine_face;   // per coarse face: the fine face that it grew from, and whose rest frame it keeps
    std::vector<int> absorber;    // per fine node: the coarse node that it was drawn into
};

/// Draws nodes into neighbours, shortest edges first, until about `target` are left or no more can go without folding the
/// surface over. Borders, creases and held nodes keep their lines: a node of one is only drawn along it, its corners stay.
///
/// @param held  3n flags; a held node is only drawn into one that is held in the same axes
CoarseMesh coarsen(const arcsim::Surface& fine, const std::vector<char>& held, int target);

}  // namespace formwork
