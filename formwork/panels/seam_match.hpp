#pragma once

#include "formwork/flatten/flatten.hpp"
#include "formwork/panels/panel_set.hpp"

namespace formwork {

/// Gives both sides of every sewn seam the same flat length, and the same lengths along it, at the least
/// distortion of all panels together:
///
///   min sum_p A_p E_p(u_p)   subject to   c_j = length_a,j - length_b,j = 0   for every stretch j of every seam
///
/// by sequential quadratic programming: projected Newton Hessians H_p, constraint rows B,
/// (B H⁻¹ Bᵀ) lambda = c - B H⁻¹ g, step -H⁻¹ (g + Bᵀ lambda), line search on the energy plus an exact penalty
/// [Nocedal and Wright 2006, ch. 18]. No face turns over.
/// @param shapes  per panel, per face (rest_shapes)
/// @returns the largest |c_j| over its length on the surface, after the solve
double match_seams(PanelSet& set, const Segmentation& s, const std::vector<std::vector<Matrix2d>>& shapes);

/// Sets length, mismatch, local_mismatch and notch of every seam from the flat coordinates.
void measure_seams(PanelSet& set, const Segmentation& s);

}  // namespace formwork
