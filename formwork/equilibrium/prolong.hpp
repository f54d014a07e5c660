#pragma once

#include "formwork/equilibrium/coarse_mesh.hpp"

namespace formwork {

/// quadratic: to third order. At every coarse node a quadratic through its value is fitted to its two rings, and a fine node
/// blends those of its face's corners by barycentric weights. (Linear interpolation cuts corners: chords are shorter than the
/// arcs between their ends, and a membrane that starts compressed has to lose those wrinkles first.)
/// linear: for wrinkled shapes. Their displacements are rough at the mesh's scale; a quadratic overshoots (a woven pillow
/// started with a stretch of 2), while a tension field takes the shorter chords for nothing.
enum class Interpolation { quadratic, linear };

/// Carries displacements of the coarse nodes to the fine ones.
///
/// @param u     displacement per coarse node, m
/// @param fine  the mesh that was coarsened
/// @returns     displacement per fine node, m
std::vector<arcsim::Vector3d> prolong(const CoarseMesh& coarse, const std::vector<arcsim::Vector3d>& u,
                                      const arcsim::Surface& fine,
                                      Interpolation interpolation = Interpolation::quadratic);

}  // namespace formwork
