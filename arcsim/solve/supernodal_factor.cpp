#include "arcsim/solve/supernodal_factor.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "arcsim/base/error.hpp"
#include "arcsim/base/flush_denormals.hpp"

namespace arcsim {
template <class Real>
SupernodalFactor<Real>::SupernodalFactor(std::shared_ptr<const Supernodes> shape, const BlockPattern& pattern)
    : shape_(std::move(shape)), diagonal_(3 * shape_->n_nodes()) {
    const auto& list = shape_->list();
    int widest = 0, tallest = 0;
    for (std::size_t s = 0; s < list.size(); ++s) {
        offsets_.push_back(size_);
        const Panel p = panel(static_cast<int>(s));
        size_ += p.block_begin(p.blocks);
        widest = std::max(widest, L * p.blocks);
        tallest = std::max(tallest, L * (p.blocks - p.diagonal_blocks));
    }
    if (size_ > std::numeric_limits<std::uint32_t>::max())
        throw NumericalError("the factor of " + std::to_string(3 * shape_->n_nodes()) + " equations is too large");
    values_ = aligned_array<Real>(size_);
    strip_ = aligned_array<Real>(static_cast<std::size_t>(panel::tile_blocks) * L * (tallest + L));
    work_ = aligned_array<Real>(static_cast<std::size_t>(2 + L) * (widest + L));

    const auto& position = shape_->position();
    place_at_.resize(pattern.n_nodes());
    for (int place = 0; place < pattern.n_nodes(); ++place) place_at_[position[place]] = place;
    entries_.reserve(pattern.block_row().size());
    for (int j = 0; j < pattern.n_nodes(); ++j)
        for (int k = pattern.block_ptr()[j]; k < pattern.block_ptr()[j + 1]; ++k) {
            const int s = shape_->owner()[position[j]];
            const Panel p = panel(s);
            const int column = 3 * (position[j] - list[s].first);
            const int row = p.row_of(shape_->local(s, position[pattern.block_row()[k]]));
            std::array<std::uint32_t, 3> at;
            for (int r = 0; r < 3; ++r) at[r] = static_cast<std::uint32_t>(offsets_[s] + p.entry(row + r, column));
            entries_.push_back(at);
        }
}

/// Clears a panel and puts A's entries in, just before its first use, so that it stays in the cache.
template <class Real>
void SupernodalFactor<Real>::ensure_started(const BlockMatrix& A, int s) {
    if (started_[s]) return;
    started_[s] = 1;
    const BlockPattern& pattern = A.pattern();
    const Supernodes::Supernode& node = shape_->list()[s];
    const Panel p = panel(s);
    std::memset(p.values, 0, p.block_begin(p.blocks) * sizeof(Real));
    for (int position = node.first; position < node.first + node.n_cols; ++position) {
        const int j = place_at_[position];
        const int n_blocks = pattern.block_ptr()[j + 1] - pattern.block_ptr()[j], stride = 3 * n_blocks;
        const double* a = A.values() + pattern.col_ptr()[3 * j];
        const std::array<std::uint32_t, 3>* to = entries_.data() + pattern.block_ptr()[j];
        for (int c = 0; c < 3; ++c) {
            diagonal_[3 * position + c] = static_cast<Real>(a[c * stride + c]);
            for (int r = c; r < 3; ++r) values_[to[0][r] + L * c] = static_cast<Real>(a[c * stride + r]);
        }
        for (int k = 1; k < n_blocks; ++k)
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 3; ++r) values_[to[k][r] + L * c] = static_cast<Real>(a[c * stride + 3 * k + r]);
    }
}

template <class Real>
int SupernodalFactor<Real>::factorize(const BlockMatrix& A, Real least_pivot) {
    const FlushDenormals scope;
    const int n = static_cast<int>(shape_->list().size());
    started_.assign(n, 0);
    for (int s = 0; s < n; ++s) {
        ensure_started(A, s);
        const int first = shape_->list()[s].first;
        const Panel p = panel(s);
        const int failed = factorize_panel(p, first, least_pivot);
        if (failed >= 0) return 3 * first + failed;
        invert_triangles(p);
        update_later(A, s, p);
    }
    return -1;
}

namespace {

/// Factor of the C x C part of a tile that starts at lane `at`. @returns the column whose pivot fails, or -1
template <class Real, int C>
int factorize_triangle(const panel::Vec<Real> (&tile)[1][C], int at, const Real* diagonal, Real least_pivot,
                       panel::Triangle<Real, C>& t) {
    for (int c = 0; c < C; ++c)
        for (int r = c; r < C; ++r) t.l[r][c] = tile[0][c][at + r];
    for (int c = 0; c < C; ++c) {
        if (!(t.l[c][c] > least_pivot * diagonal[c])) return c;
        t.inverse[c] = 1 / std::sqrt(t.l[c][c]);
        if (!std::isfinite(t.inverse[c])) return c;
        for (int r = c + 1; r < C; ++r) t.l[r][c] *= t.inverse[c];
        for (int d = c + 1; d < C; ++d)
            for (int r = d; r < C; ++r) t.l[r][d] -= t.l[r][c] * t.l[d][c];
    }
    return -1;
}

}  // namespace

/// Left-looking over tile_columns columns at a time. The diagonal keeps the inverses.
template <class Real>
int SupernodalFactor<Real>::factorize_panel(const Panel& p, int first, Real least_pivot) {
    int failed = -1;
    for (int j = 0; j < p.w && failed < 0; j += panel::tile_columns) {
        panel::with_columns(p.w - j, [&]<int C>() {
            const int own = j / L, at = j % L;
            const Real* b = p.block(own) + at;
            panel::Triangle<Real, C> triangle;
            {
                Vec* out = reinterpret_cast<Vec*>(p.block(own)) + j;
                Vec acc[1][C];
                for (int c = 0; c < C; ++c) acc[0][c] = out[c];
                const Vec* const a[1] = {p.vectors(own)};
                panel::subtract_product<Real, 1, C>(a, b, j, acc);
                const int column = factorize_triangle<Real, C>(acc, at, &diagonal_[3 * first + j], least_pivot, triangle);
                if (column >= 0) {
                    failed = j + column;
                    return;
                }
                panel::solve_triangle<Real, 1, C>(triangle, acc);
                for (int c = 0; c < C; ++c) {
                    acc[0][c][at + c] = triangle.inverse[c];
                    out[c] = acc[0][c];
                }
            }
            panel::for_row_blocks(own + 1, p.blocks, [&]<int R>(int block) {
                Vec* out[R];
                const Vec* a[R];
                Vec acc[R][C];
                for (int r = 0; r < R; ++r) {
                    a[r] = p.vectors(block + r);
                    out[r] = reinterpret_cast<Vec*>(p.block(block + r)) + j;
                    for (int c = 0; c < C; ++c) acc[r][c] = out[r][c];
                }
                panel::subtract_product<Real, R, C>(a, b, j, acc);
                panel::solve_triangle<Real, R, C>(triangle, acc);
                for (int r = 0; r < R; ++r)
                    for (int c = 0; c < C; ++c) out[r][c] = acc[r][c];
            });
        });
    }
    return failed;
}

/// Row r of a triangle's inverse is (e_r - sum over k < r of T_rk row_k) / T_rr.
template <class Real>
void SupernodalFactor<Real>::invert_triangles(const Panel& p) {
    for (int b = 0; b < p.diagonal_blocks; ++b) {
        Real* t = p.block(b) + static_cast<std::size_t>(L) * L * b;
        const int n = std::min(L, p.w - L * b);
        alignas(64) Real inverse[L][L];
        for (int r = 0; r < n; ++r) {
            Vec row = {};
            row[r] = 1;
            for (int k = 0; k < r; ++k) row -= *reinterpret_cast<const Vec*>(inverse[k]) * t[L * k + r];
            *reinterpret_cast<Vec*>(inverse[r]) = row * t[L * r + r];
        }
        for (int c = 0; c < n; ++c)
            for (int r = 0; r < L; ++r) t[L * c + r] = r >= n ? 0 : r > c ? inverse[r][c] : inverse[c][r];
    }
}

/// Later panels -= B Bᵀ, B the rows below the diagonal: strips of three row blocks, lower triangle only.
template <class Real>
void SupernodalFactor<Real>::update_later(const BlockMatrix& A, int s, const Panel& p) {
    const Supernodes::Supernode& node = shape_->list()[s];
    for (int k = node.update_begin; k < node.update_end; ++k) ensure_started(A, shape_->updates()[k].target);
    const int below = p.blocks - p.diagonal_blocks;
    panel::for_row_blocks(0, below, [&]<int R>(int block) {
        const int width = std::min(p.m, L * (block + R));   // columns of the strip
        Vec* strip = reinterpret_cast<Vec*>(strip_.get());
        const Vec* a[R];
        for (int r = 0; r < R; ++r) a[r] = p.vectors(p.diagonal_blocks + block + r);
        const auto tile = [&]<int Rows, int C>(int skip, int j) {   // row blocks `skip` .. R - 1 of the strip
            const Vec* rows[Rows];
            Vec acc[Rows][C] = {};
            for (int r = 0; r < Rows; ++r) rows[r] = a[skip + r];
            panel::subtract_product<Real, Rows, C>(rows, p.block(p.diagonal_blocks + j / L) + j % L, p.w, acc);
            for (int r = 0; r < Rows; ++r)
                for (int c = 0; c < C; ++c) strip[(skip + r) * width + j + c] = acc[r][c];
        };
        for (int j = 0; j < width; j += panel::tile_columns)
            panel::with_columns(width - j, [&]<int C>() {
                const int skip = std::max(0, j / L - block);
                if (skip == 0) tile.template operator()<R, C>(0, j);
                if constexpr (R > 1)
                    if (skip == 1) tile.template operator()<R - 1, C>(1, j);
                if constexpr (R > 2)
                    if (skip == 2) tile.template operator()<R - 2, C>(2, j);
            });
        scatter_strip<R>(s, block, width);
    });
}

/// Adds a strip of the update to the panels that own its columns.
template <class Real>
template <int R>
void SupernodalFactor<Real>::scatter_strip(int s, int first_block, int width) {
    const Supernodes::Supernode& from = shape_->list()[s];
    const int end = std::min(3 * from.n_rows, L * (first_block + R));
    for (int k = from.update_begin; k < from.update_end; ++k) {
        const Supernodes::Update& u = shape_->updates()[k];
        const int begin = std::max(3 * u.row, L * first_block);   // first row that may lie on or below a column
        if (3 * u.row >= width) break;
        const int* local = shape_->local_rows().data() + u.local_begin - u.row;
        const Panel t = panel(u.target);
        std::int32_t to[R * L] = {};
        for (int node = begin / 3; 3 * node < end; ++node) {
            const int row = t.row_of(local[node]);
            for (int r = std::max(0, begin - 3 * node); r < 3 && 3 * node + r < end; ++r)
                to[3 * node + r - L * first_block] = static_cast<std::int32_t>(t.entry(row + r, 0));
        }
        for (int b = 0; b < R; ++b) {
            const int row0 = L * (first_block + b);
            const Vec* strip = reinterpret_cast<const Vec*>(strip_.get()) + b * width;
            const int last_row = std::min(end, row0 + L);
            for (int node = u.row; node < u.row + u.n && 3 * node < last_row; ++node)
                for (int c = 0; c < 3; ++c) {
                    const int j = 3 * node + c;
                    Real* out = t.values + static_cast<std::size_t>(L) * (3 * local[node] + c);
                    panel::scatter_add<Real>(out, to + b * L, strip[j], std::max(0, j - row0), last_row - row0);
                }
        }
    }
}

template SupernodalFactor<float>::SupernodalFactor(std::shared_ptr<const Supernodes>, const BlockPattern&);
template SupernodalFactor<double>::SupernodalFactor(std::shared_ptr<const Supernodes>, const BlockPattern&);
template int SupernodalFactor<float>::factorize(const BlockMatrix&, float);
template int SupernodalFactor<double>::factorize(const BlockMatrix&, double);

}  // namespace arcsim
