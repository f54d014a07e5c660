#pragma once

#include <cstdint>
#include <memory>

#include "arcsim/base/aligned_array.hpp"
#include "arcsim/solve/linear_solver.hpp"
#include "arcsim/solve/panel_tiles.hpp"
#include "arcsim/solve/supernodes.hpp"

namespace arcsim {

/// A = L Lᵀ in the precision of Real, right-looking by supernodes: a finished panel's outer product is formed in registers,
/// tile by tile, and added to the later panels where its rows belong. Beside L there is only a strip of work space.
///
/// Vectors go by position (see Supernodes), 3 unknowns each. `float` has twice the speed and half the memory of
/// `double`; it serves as a preconditioner.
template <class Real>
class SupernodalFactor {
public:
    explicit SupernodalFactor(std::shared_ptr<const Supernodes> shape, const BlockPattern& pattern);

    const Supernodes& shape() const { return *shape_; }
    /// @returns the position of the pivot that is not positive, or drowned in rounding: below `least_pivot` of its
    /// diagonal entry; -1: all well
    int factorize(const BlockMatrix& A, Real least_pivot);
    /// x = A⁻¹ x, 3 n_nodes.
    void solve(Real* x) const;
    std::size_t bytes() const { return sizeof(Real) * size_ + sizeof(entries_[0]) * entries_.size(); }

private:
    using Vec = panel::Vec<Real>;
    static constexpr int L = panel::lanes<Real>;

    /// One supernode's panel: its diagonal row blocks store the columns up to their own end, those below all w columns.
    /// When finished, a diagonal block's own L columns hold the inverse of their triangle, mirrored: forward substitution
    /// reads the lower half, backward the upper one, and neither waits for one unknown after another.
    struct Panel {
        Real* values;
        int w, m;                       // columns; rows below
        int diagonal_blocks, blocks;    // rows below start a new block
        std::size_t block_begin(int b) const {
            const std::size_t d = diagonal_blocks;
            if (b < diagonal_blocks) return static_cast<std::size_t>(L) * L * b * (b + 1) / 2;
            return static_cast<std::size_t>(L) * (L * d * (d - 1) / 2 + w + (b - d) * w);
        }
        Real* block(int b) const { return values + block_begin(b); }
        const Vec* vectors(int b) const { return reinterpret_cast<const Vec*>(block(b)); }
        /// Row of the padded panel at which a local node (column or row below) begins.
        int row_of(int local) const {
            return 3 * local < w ? 3 * local : L * diagonal_blocks + 3 * local - w;
        }
        std::size_t entry(int row, int column) const {
            return block_begin(row / L) + static_cast<std::size_t>(row % L) + static_cast<std::size_t>(L) * column;
        }
    };
    static constexpr int blocks_of(int rows) { return (rows + L - 1) / L; }
    Panel panel(int s) const {
        const Supernodes::Supernode& n = shape_->list()[s];
        const int diagonal = blocks_of(3 * n.n_cols);
        return {values_.get() + offsets_[s], 3 * n.n_cols, 3 * n.n_rows, diagonal, diagonal + blocks_of(3 * n.n_rows)};
    }

    void ensure_started(const BlockMatrix& A, int s);
    int factorize_panel(const Panel& p, int first, Real least_pivot);
    void invert_triangles(const Panel& p);
    void update_later(const BlockMatrix& A, int s, const Panel& p);
    template <int R>
    void scatter_strip(int s, int first_block, int width);
    void solve_forward(int s, Real* x) const;
    void solve_backward(int s, Real* x) const;

    std::shared_ptr<const Supernodes> shape_;
    std::vector<std::size_t> offsets_;              // of the panels
    std::size_t size_ = 0;
    std::vector<std::array<std::uint32_t, 3>> entries_;   // per block of the pattern: where its rows' first column goes
    AlignedArray<Real> values_, strip_, work_;
    std::vector<Real> diagonal_;                    // of A, by position
    std::vector<int> place_at_;                     // pattern's place of each position
    std::vector<char> started_;                     // panels that hold A's entries
};

}  // namespace arcsim
