#pragma once

#include "arcsim/base/block_matrix.hpp"
#include "arcsim/base/lanes.hpp"

namespace arcsim {

/// Stiffness blocks of eight faces between their corners 1 and 2, entry (r, c) at [r + 3 c]. A membrane resists no
/// translation, so that rows and columns of corner 0 follow: K_0j = -(K_1j + K_2j).
struct BlockLanes {
    Lanes b11[9], b12[9], b22[9];
};

/// The six stored blocks of eight faces: (0,1), (1,2), (2,0) and the diagonal ones; [r + 3 c].
struct AllBlockLanes {
    Lanes pair[3][9], diagonal[3][9];
};

enum class Half { symmetric, antisymmetric };   // of a BlockMatrix: block (j, i) is + or - the transpose of (i, j)

/// Corner 0's blocks from the others'.
AllBlockLanes complete(const BlockLanes& K, Half half);

/// Adds the blocks of faces first_face .. first_face + n - 1 to one half of a matrix's values.
/// @param node  of the three corners; [corner][lane]
void scatter(const AllBlockLanes& K, Half half, const int node[3][n_lanes], int first_face, int n,
             const BlockPattern& pattern, double* values);

}  // namespace arcsim
