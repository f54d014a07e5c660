#pragma once

#include <array>
#include <vector>

#include "arcsim/base/types.hpp"

namespace arcsim {

/// Where the 3x3 block that couples node i to node j lies among a BlockMatrix's values: entry (r, c) of the
/// stored block is at first + r + c * stride. Only one of (i, j) and (j, i) is stored.
struct BlockSlot {
    int first = -1;
    int stride = 0;
    bool transposed = false;   // the stored block is (j, i)
};

/// Which nodes touch which: fixed for the life of a mesh, so that matrices are written in place.
///
/// The matrix is the lower triangle, in scalar compressed columns, of a 3n x 3n symmetric matrix whose
/// nodes stand in the order `node_at` (the fill order: with it the factorisation needs no permutation of
/// its own). Callers speak of nodes by their own numbers throughout. Each scalar column of a block column
/// has the same rows, so the 3x3 diagonal blocks are stored whole; their upper entries are not read.
class BlockPattern {
public:
    /// @param faces     every pair of a face's corners is coupled
    /// @param pairs     further coupled nodes: hinges, springs
    /// @param node_at   node at each place of the fill order; empty: natural order
    BlockPattern(int n_nodes, const std::vector<Triangle>& faces, const std::vector<std::array<int, 2>>& pairs = {},
                 std::vector<int> node_at = {});

    int n_nodes() const { return n_nodes_; }
    int n_dofs() const { return 3 * n_nodes_; }
    int n_values() const { return col_ptr_.back(); }

    /// @throws std::out_of_range (a bug of ours): the nodes are not coupled
    BlockSlot slot(int i, int j) const;
    BlockSlot diagonal(int i) const { return diagonal_[i]; }
    /// Blocks (corner 0, corner 1), (1, 2) and (2, 0) of face f.
    const std::array<BlockSlot, 3>& face_slots(int f) const { return face_slots_[f]; }

    const std::vector<int>& node_at() const { return node_at_; }
    const std::vector<int>& place_of() const { return place_of_; }
    const std::vector<int>& block_ptr() const { return block_ptr_; }       // per place: its blocks in block_row
    const std::vector<int>& block_row() const { return block_row_; }       // places, ascending; diagonal first
    const std::vector<int>& col_ptr() const { return col_ptr_; }           // scalar, 3n + 1
    const std::vector<int>& row_index() const { return row_index_; }       // scalar

private:
    int n_nodes_;
    std::vector<int> node_at_, place_of_, block_ptr_, block_row_, col_ptr_, row_index_;
    std::vector<BlockSlot> diagonal_;
    std::vector<std::array<BlockSlot, 3>> face_slots_;
};

/// Degrees of freedom (3 node + axis) that are held, and the matrix entries that this touches.
class FixedDofs {
public:
    FixedDofs() = default;
    /// @param fixed  3n flags, by 3 node + axis
    FixedDofs(const BlockPattern& pattern, std::vector<char> fixed);
    bool operator[](int dof) const { return fixed_[dof] != 0; }
    const std::vector<char>& flags() const { return fixed_; }
    int n_free() const { return n_free_; }
    void clear(VectorXd& v) const {                         // zero at the held degrees of freedom
        for (int d : list_) v[d] = 0;
    }
    const std::vector<int>& list() const { return list_; }
    const std::vector<int>& zero_entries() const { return zero_; }
    const std::vector<int>& one_entries() const { return one_; }

private:
    std::vector<char> fixed_;
    std::vector<int> list_, zero_, one_;
    int n_free_ = 0;
};

/// A sparse matrix of 3x3 blocks, split into its symmetric half (what Cholesky reads) and, when asked for,
/// its antisymmetric half: a force adds its exact, unsymmetric blocks, and symmetrising costs nothing.
class BlockMatrix {
public:
    enum class Kind { symmetric, general };                 // symmetric: the antisymmetric half is dropped

    explicit BlockMatrix(const BlockPattern& pattern, Kind kind = Kind::symmetric);   // keeps a reference

    const BlockPattern& pattern() const { return *pattern_; }
    bool is_general() const { return !skew_.empty(); }
    void set_zero();

    /// Adds K_ij at the slot of (i, j), and its transpose at (j, i).
    void add(const BlockSlot& s, const Matrix3d& K_ij);
    /// Adds K_ij at (i, j) and K_ji at (j, i).
    void add(const BlockSlot& s, const Matrix3d& K_ij, const Matrix3d& K_ji);
    void add_diagonal(int node, const Matrix3d& K);
    void add_to_diagonal(int node, double value);           // value * identity
    /// this += factor * other, of the same pattern.
    void add_scaled(const BlockMatrix& other, double factor);
    void scale(double factor);

    /// Replaces the rows and columns of held degrees of freedom by the identity's.
    void fix(const FixedDofs& fixed);

    /// y = A x, by node numbers.
    void multiply(const VectorXd& x, VectorXd& y) const;
    /// y = ½(A + Aᵀ) x.
    void multiply_symmetric(const VectorXd& x, VectorXd& y) const;
    /// The diagonal, by node numbers.
    VectorXd diagonal() const;

    double* values() { return values_.data(); }             // symmetric half, lower triangle
    const double* values() const { return values_.data(); }
    double* skew_values() { return skew_.empty() ? nullptr : skew_.data(); }
    const double* skew_values() const { return skew_.empty() ? nullptr : skew_.data(); }
    MatrixXd dense() const;                                 // by node numbers; for tests

private:
    const BlockPattern* pattern_;
    std::vector<double> values_, skew_;
};

}  // namespace arcsim
