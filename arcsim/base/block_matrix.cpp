#include "arcsim/base/block_matrix.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <stdexcept>
#include <string>

namespace arcsim {
namespace {

using Block = Eigen::Map<Matrix3d, 0, Eigen::OuterStride<>>;

Block block(double* values, const BlockSlot& s) {
    return Block(values + s.first, Eigen::OuterStride<>(s.stride));
}

/// Lower neighbours of every place, ascending, the place itself first.
void build_columns(int n, const std::vector<int>& place_of, const std::vector<Triangle>& faces,
                   const std::vector<std::array<int, 2>>& pairs, std::vector<int>& ptr, std::vector<int>& row) {
    std::vector<int> count(n + 1, 0);
    const auto for_all = [&](auto&& visit) {
        for (const Triangle& t : faces)
            for (int k = 0; k < 3; ++k) visit(place_of[t[k]], place_of[t[(k + 1) % 3]]);
        for (const auto& p : pairs) visit(place_of[p[0]], place_of[p[1]]);
    };
    for_all([&](int a, int b) { ++count[std::min(a, b) + 1]; });
    std::partial_sum(count.begin(), count.end(), count.begin());
    std::vector<int> all(count.back()), next(count.begin(), count.end() - 1);
    for_all([&](int a, int b) { all[next[std::min(a, b)]++] = std::max(a, b); });
    ptr.assign(1, 0);
    row.clear();
    row.reserve(n + all.size() / 2 + 1);
    for (int j = 0; j < n; ++j) {
        row.push_back(j);
        std::sort(all.begin() + count[j], all.begin() + count[j + 1]);
        for (int k = count[j]; k < count[j + 1]; ++k)
            if (all[k] != row.back()) row.push_back(all[k]);
        ptr.push_back(static_cast<int>(row.size()));
    }
    row.shrink_to_fit();
}

/// y += sign-aware product with one half: `skew` changes the sign of the mirrored blocks.
template <bool skew>
void multiply_half(const BlockPattern& p, const double* values, const VectorXd& x, VectorXd& y) {
    const auto& ptr = p.block_ptr();
    const auto& row = p.block_row();
    const auto& node = p.node_at();
    const double* v = values;
    for (int j = 0; j < p.n_nodes(); ++j) {
        const int n_blocks = ptr[j + 1] - ptr[j];
        const int stride = 3 * n_blocks;
        const double* xj = x.data() + 3 * node[j];
        const double x0 = xj[0], x1 = xj[1], x2 = xj[2];
        const double *c0 = v, *c1 = v + stride, *c2 = v + 2 * stride;
        double y0, y1, y2;
        if constexpr (skew) {
            y0 = -c0[1] * x1 - c0[2] * x2;
            y1 = c0[1] * x0 - c1[2] * x2;
            y2 = c0[2] * x0 + c1[2] * x1;
        } else {
            y0 = c0[0] * x0 + c0[1] * x1 + c0[2] * x2;
            y1 = c0[1] * x0 + c1[1] * x1 + c1[2] * x2;
            y2 = c0[2] * x0 + c1[2] * x1 + c2[2] * x2;
        }
        constexpr double mirrored = skew ? -1 : 1;
        for (int k = 1; k < n_blocks; ++k) {
            const int i = 3 * node[row[ptr[j] + k]];
            const double *b0 = c0 + 3 * k, *b1 = c1 + 3 * k, *b2 = c2 + 3 * k;
            const double u0 = mirrored * x[i], u1 = mirrored * x[i + 1], u2 = mirrored * x[i + 2];
            y[i] += b0[0] * x0 + b1[0] * x1 + b2[0] * x2;
            y[i + 1] += b0[1] * x0 + b1[1] * x1 + b2[1] * x2;
            y[i + 2] += b0[2] * x0 + b1[2] * x1 + b2[2] * x2;
            y0 += b0[0] * u0 + b0[1] * u1 + b0[2] * u2;
            y1 += b1[0] * u0 + b1[1] * u1 + b1[2] * u2;
            y2 += b2[0] * u0 + b2[1] * u1 + b2[2] * u2;
        }
        double* yj = y.data() + 3 * node[j];
        yj[0] += y0;
        yj[1] += y1;
        yj[2] += y2;
        v += 3 * stride;
    }
}

}  // namespace

BlockPattern::BlockPattern(int n_nodes, const std::vector<Triangle>& faces,
                           const std::vector<std::array<int, 2>>& pairs, std::vector<int> node_at)
    : n_nodes_(n_nodes), node_at_(std::move(node_at)), place_of_(n_nodes) {
    if (node_at_.empty()) {
        node_at_.resize(n_nodes);
        std::iota(node_at_.begin(), node_at_.end(), 0);
    }
    assert(static_cast<int>(node_at_.size()) == n_nodes);
    for (int p = 0; p < n_nodes; ++p) place_of_[node_at_[p]] = p;
    build_columns(n_nodes, place_of_, faces, pairs, block_ptr_, block_row_);

    col_ptr_.reserve(3 * n_nodes + 1);
    col_ptr_.push_back(0);
    row_index_.reserve(9 * block_row_.size());
    diagonal_.resize(n_nodes);
    for (int j = 0; j < n_nodes; ++j) {
        const int stride = 3 * (block_ptr_[j + 1] - block_ptr_[j]);
        diagonal_[node_at_[j]] = {col_ptr_.back(), stride, false};
        for (int c = 0; c < 3; ++c) {
            for (int k = block_ptr_[j]; k < block_ptr_[j + 1]; ++k)
                for (int r = 0; r < 3; ++r) row_index_.push_back(3 * block_row_[k] + r);
            col_ptr_.push_back(static_cast<int>(row_index_.size()));
        }
    }
    face_slots_.reserve(faces.size());
    for (const Triangle& t : faces)
        face_slots_.push_back({slot(t[0], t[1]), slot(t[1], t[2]), slot(t[2], t[0])});
}

BlockSlot BlockPattern::slot(int i, int j) const {
    const int pi = place_of_[i], pj = place_of_[j];
    const int col = std::min(pi, pj), row = std::max(pi, pj);
    const auto begin = block_row_.begin() + block_ptr_[col], end = block_row_.begin() + block_ptr_[col + 1];
    const auto it = std::lower_bound(begin, end, row);
    if (it == end || *it != row)
        throw std::out_of_range("BlockPattern: nodes " + std::to_string(i) + " and " + std::to_string(j) +
                                " are not coupled");
    return {col_ptr_[3 * col] + 3 * static_cast<int>(it - begin), 3 * static_cast<int>(end - begin), pi < pj};
}

FixedDofs::FixedDofs(const BlockPattern& p, std::vector<char> fixed) : fixed_(std::move(fixed)) {
    assert(static_cast<int>(fixed_.size()) == p.n_dofs());
    for (int d = 0; d < p.n_dofs(); ++d)
        if (fixed_[d]) list_.push_back(d);
    n_free_ = p.n_dofs() - static_cast<int>(list_.size());
    const auto& node = p.node_at();
    for (int j = 0; j < p.n_nodes(); ++j)
        for (int c = 0; c < 3; ++c) {
            const bool column_held = fixed_[3 * node[j] + c];
            int entry = p.col_ptr()[3 * j + c];
            for (int k = p.block_ptr()[j]; k < p.block_ptr()[j + 1]; ++k)
                for (int r = 0; r < 3; ++r, ++entry) {
                    const int i = p.block_row()[k];
                    if (!column_held && !fixed_[3 * node[i] + r]) continue;
                    (i == j && r == c ? one_ : zero_).push_back(entry);
                }
        }
}

BlockMatrix::BlockMatrix(const BlockPattern& pattern, Kind kind)
    : pattern_(&pattern), values_(pattern.n_values(), 0.0),
      skew_(kind == Kind::general ? pattern.n_values() : 0, 0.0) {}

void BlockMatrix::set_zero() {
    std::fill(values_.begin(), values_.end(), 0.0);
    std::fill(skew_.begin(), skew_.end(), 0.0);
}

void BlockMatrix::add(const BlockSlot& s, const Matrix3d& K_ij) {
    if (s.transposed)
        block(values_.data(), s) += K_ij.transpose();
    else
        block(values_.data(), s) += K_ij;
}

void BlockMatrix::add(const BlockSlot& s, const Matrix3d& K_ij, const Matrix3d& K_ji) {
    const Matrix3d& lower = s.transposed ? K_ji : K_ij;
    const Matrix3d& upper = s.transposed ? K_ij : K_ji;
    block(values_.data(), s) += 0.5 * (lower + upper.transpose());
    if (is_general()) block(skew_.data(), s) += 0.5 * (lower - upper.transpose());
}

void BlockMatrix::add_diagonal(int node, const Matrix3d& K) {
    const BlockSlot s = pattern_->diagonal(node);
    block(values_.data(), s) += 0.5 * (K + K.transpose());
    if (is_general()) block(skew_.data(), s) += 0.5 * (K - K.transpose());
}

void BlockMatrix::add_to_diagonal(int node, double value) {
    const BlockSlot s = pattern_->diagonal(node);
    for (int c = 0; c < 3; ++c) values_[s.first + c * (s.stride + 1)] += value;
}

void BlockMatrix::add_scaled(const BlockMatrix& other, double factor) {
    assert(other.values_.size() == values_.size());
    for (std::size_t k = 0; k < values_.size(); ++k) values_[k] += factor * other.values_[k];
    if (is_general() && other.is_general())
        for (std::size_t k = 0; k < skew_.size(); ++k) skew_[k] += factor * other.skew_[k];
}

void BlockMatrix::scale(double factor) {
    for (double& v : values_) v *= factor;
    for (double& v : skew_) v *= factor;
}

void BlockMatrix::fix(const FixedDofs& fixed) {
    for (int k : fixed.zero_entries()) values_[k] = 0;
    for (int k : fixed.one_entries()) values_[k] = 1;
    if (!is_general()) return;
    for (int k : fixed.zero_entries()) skew_[k] = 0;
    for (int k : fixed.one_entries()) skew_[k] = 0;
}

void BlockMatrix::multiply(const VectorXd& x, VectorXd& y) const {
    multiply_symmetric(x, y);
    if (is_general()) multiply_half<true>(*pattern_, skew_.data(), x, y);
}

void BlockMatrix::multiply_symmetric(const VectorXd& x, VectorXd& y) const {
    y.setZero(x.size());
    multiply_half<false>(*pattern_, values_.data(), x, y);
}

VectorXd BlockMatrix::diagonal() const {
    VectorXd d(pattern_->n_dofs());
    for (int i = 0; i < pattern_->n_nodes(); ++i) {
        const BlockSlot s = pattern_->diagonal(i);
        for (int c = 0; c < 3; ++c) d[3 * i + c] = values_[s.first + c * (s.stride + 1)];
    }
    return d;
}

MatrixXd BlockMatrix::dense() const {
    const int n = pattern_->n_dofs();
    MatrixXd A(n, n);
    VectorXd e = VectorXd::Zero(n), y(n);
    for (int d = 0; d < n; ++d) {
        e[d] = 1;
        multiply(e, y);
        A.col(d) = y;
        e[d] = 0;
    }
    return A;
}

}  // namespace arcsim
