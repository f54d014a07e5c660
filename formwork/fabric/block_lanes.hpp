#pragma once

#include "arcsim/base/block_matrix.hpp"
#include "arcsim/base/lanes.hpp"

namespace formwork {

using arcsim::BlockPattern;
using arcsim::Lanes;

/// Stiffness blocks of eight faces between their corners 1 and 2, entry (r, c) at [r + 3 c]. A membrane resists no
/// translation, so that rows and columns of corner 0 follow: K_0j = -(K_1j + K_2j).
struct BlockLanes {
    Lanes b11[9], b12[9], b22[9];
};

/// Adds the nine blocks of faces first_face .. first_face + n - 1; K_21 = K_12ᵀ.
void scatter_symmetric(const BlockLanes& K, const int node[3][arcsim::n_lanes], int first_face, int n,
                       const BlockPattern& pattern, double* values);
/// The same for the antisymmetric half: K_21 = -K_12ᵀ.
void scatter_skew(const BlockLanes& K, const int node[3][arcsim::n_lanes], int first_face, int n,
                  const BlockPattern& pattern, double* values);

}  // namespace formwork
