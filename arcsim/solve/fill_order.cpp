#include "arcsim/solve/fill_order.hpp"

#include <cholmod.h>

#include <numeric>

#include "arcsim/base/block_matrix.hpp"
#include "arcsim/base/error.hpp"

namespace arcsim {

std::vector<int> fill_order(int n_nodes, const std::vector<Triangle>& faces,
                            const std::vector<std::array<int, 2>>& pairs, FillOrder order) {
    std::vector<int> node_at(n_nodes);
    std::iota(node_at.begin(), node_at.end(), 0);
    if (order == FillOrder::natural || n_nodes == 0) return node_at;
    constexpr int metis_pays_from = 8000;   // nodes; measured: below, AMD's factor is as sparse and its order cheaper
    if (order == FillOrder::automatic) order = n_nodes < metis_pays_from ? FillOrder::amd : FillOrder::metis;

    // CHOLMOD's analysis of the graph of nodes does both the ordering and the postordering.
    cholmod_common common;
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SIMPLICIAL;
    common.nmethods = 1;
    common.postorder = 1;
    common.method[0].ordering = order == FillOrder::amd ? CHOLMOD_AMD : CHOLMOD_METIS;

    const BlockPattern graph(n_nodes, faces, pairs);
    std::vector<int> ptr = graph.block_ptr(), row = graph.block_row();
    cholmod_sparse A{};
    A.nrow = A.ncol = n_nodes;
    A.nzmax = row.size();
    A.p = ptr.data();
    A.i = row.data();
    A.stype = -1;
    A.itype = CHOLMOD_INT;
    A.xtype = CHOLMOD_PATTERN;
    A.sorted = A.packed = 1;
    cholmod_factor* L = cholmod_analyze(&A, &common);
    if (L) {
        const int* perm = static_cast<const int*>(L->Perm);
        node_at.assign(perm, perm + n_nodes);
        cholmod_free_factor(&L, &common);
    }
    const bool failed = common.status < 0;
    cholmod_finish(&common);
    if (failed) throw NumericalError("fill order: CHOLMOD could not order " + std::to_string(n_nodes) + " nodes");
    return node_at;
}

}  // namespace arcsim
