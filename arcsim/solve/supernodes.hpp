#pragma once

#include <vector>

#include "arcsim/base/block_matrix.hpp"

namespace arcsim {

/// The shape of a supernodal Cholesky factor, found once per pattern on the graph of nodes (3 unknowns each) and shared
/// by every factorisation of that pattern, in whatever precision.
///
/// A supernode is a run of columns with the same rows below them: its part of the factor is one dense panel. Small
/// ones are merged with their parents, at the price of stored zeros, where a model of the kernels' speed gains by it.
/// "Position" is a node's place in this elimination order: the pattern's own, with merged supernodes side by side.
class Supernodes {
public:
    /// Columns first .. first + n_cols - 1 and, below them, the positions rows()[row_begin .. row_begin + n_rows - 1].
    struct Supernode {
        int first, n_cols, row_begin, n_rows;
        int update_begin, update_end;   // among updates()
    };
    /// Rows row .. row + n - 1 of a supernode are columns of `target`: what its update of later columns goes to.
    struct Update {
        int target, row, n;
        int local_begin;   // in local_rows(): where rows row .. n_rows - 1 stand in target (columns first, then rows)
    };

    explicit Supernodes(const BlockPattern& pattern);

    int n_nodes() const { return static_cast<int>(position_.size()); }
    const std::vector<Supernode>& list() const { return list_; }
    const std::vector<int>& rows() const { return rows_; }               // positions, ascending per supernode
    const std::vector<Update>& updates() const { return updates_; }
    const std::vector<int>& local_rows() const { return local_rows_; }
    const std::vector<int>& position() const { return position_; }       // of the pattern's places
    const std::vector<int>& owner() const { return owner_; }             // supernode of each position
    /// Where position r stands among the columns and rows of supernode s.
    int local(int s, int r) const;

    double nonzeros() const { return nonzeros_; }   // of one factor, stored zeros included
    double flops() const { return flops_; }

private:
    std::vector<Supernode> list_;
    std::vector<Update> updates_;
    std::vector<int> rows_, local_rows_, position_, owner_;
    double nonzeros_ = 0, flops_ = 0;
};

}  // namespace arcsim
