#pragma once

#include <array>
#include <vector>

#include "arcsim/base/types.hpp"

namespace arcsim {

enum class FillOrder { natural, amd, metis, automatic };

/// An elimination order of the mesh's nodes that keeps Cholesky factors sparse, found on the graph of
/// nodes (a third of the matrix's rows) and postordered along its elimination tree, so that the factorisation needs
/// no permutation of its own.
///
/// automatic: AMD below 8 000 nodes, METIS's nested dissection above; scripts/bench_static measures both.
/// @returns the node at each place
std::vector<int> fill_order(int n_nodes, const std::vector<Triangle>& faces,
                            const std::vector<std::array<int, 2>>& pairs = {},
                            FillOrder order = FillOrder::automatic);

}  // namespace arcsim
