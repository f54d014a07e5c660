// The substitutions of SupernodalFactor; its factorisation is in supernodal_factor.cpp.
#include <algorithm>
#include <cstring>

#include "arcsim/base/flush_denormals.hpp"
#include "arcsim/solve/supernodal_factor.hpp"

namespace arcsim {
namespace {

constexpr int ahead = 24;   // cache lines that the streams of the factor are asked for in advance

}  // namespace

template <class Real>
void SupernodalFactor<Real>::solve_forward(int s, Real* x) const {
    const Supernodes::Supernode& node = shape_->list()[s];
    const Panel p = panel(s);
    Real* own = work_.get();   // the columns' unknowns, padded
    Real* mine = x + 3 * node.first;
    std::memcpy(own, mine, p.w * sizeof(Real));
    std::memset(own + p.w, 0, (L * p.diagonal_blocks - p.w) * sizeof(Real));
    for (int b = 0; b < p.diagonal_blocks; ++b) {
        const Vec* l = p.vectors(b);
        Vec acc[4] = {reinterpret_cast<Vec*>(own)[b]};
        for (int c = 0; c < L * b; c += 4)
            for (int i = 0; i < 4; ++i) acc[i] -= l[c + i] * own[c + i];
        Vec rest = (acc[0] + acc[1]) + (acc[2] + acc[3]);
        reinterpret_cast<Vec*>(own)[b] = rest;
        const int n = std::min(L, p.w - L * b);
        Vec x_b[2] = {};
        for (int c = 0; c < n; ++c) x_b[c % 2] += panel::from_lane<Real>(l[L * b + c], c) * own[L * b + c];
        reinterpret_cast<Vec*>(own)[b] = x_b[0] + x_b[1];
    }
    std::memcpy(mine, own, p.w * sizeof(Real));
    const int* rows = shape_->rows().data() + node.row_begin;
    const auto add_blocks = [&]<int R>(int block) {
        const Vec* l[R];
        Vec acc[R] = {};
        for (int r = 0; r < R; ++r) l[r] = p.vectors(p.diagonal_blocks + block + r);
        for (int c = 0; c < p.w; ++c)
            for (int r = 0; r < R; ++r) {
                __builtin_prefetch(l[r] + c + ahead);
                acc[r] += l[r][c] * own[c];
            }
        const int begin = L * block, end = std::min(p.m, begin + R * L);
        const Real* value = reinterpret_cast<const Real*>(acc);
        for (int k = begin; k < end; ++k) x[3 * rows[k / 3] + k % 3] -= value[k - begin];
    };
    panel::for_row_blocks(0, p.blocks - p.diagonal_blocks, add_blocks);
}

template <class Real>
void SupernodalFactor<Real>::solve_backward(int s, Real* x) const {
    const Supernodes::Supernode& node = shape_->list()[s];
    const Panel p = panel(s);
    const int n_below = L * (p.blocks - p.diagonal_blocks);
    Vec* products = reinterpret_cast<Vec*>(work_.get());              // per column, lanes not yet summed
    Real* below = work_.get() + static_cast<std::size_t>(L) * p.w;    // the rows' unknowns, padded
    const int* rows = shape_->rows().data() + node.row_begin;
    for (int k = 0; k < node.n_rows; ++k)
        for (int c = 0; c < 3; ++c) below[3 * k + c] = x[3 * rows[k] + c];
    std::fill(below + p.m, below + n_below, Real(0));
    std::memset(work_.get(), 0, static_cast<std::size_t>(L) * p.w * sizeof(Real));
    panel::for_row_blocks(0, p.blocks - p.diagonal_blocks, [&]<int R>(int block) {
        const Vec* l[R];
        Vec z[R];
        for (int r = 0; r < R; ++r) {
            l[r] = p.vectors(p.diagonal_blocks + block + r);
            z[r] = reinterpret_cast<const Vec*>(below)[block + r];
        }
        for (int c = 0; c < p.w; ++c) {
            Vec sum = products[c];
            for (int r = 0; r < R; ++r) {
                __builtin_prefetch(l[r] + c + ahead);
                sum += l[r][c] * z[r];
            }
            products[c] = sum;
        }
    });
    Real* mine = x + 3 * node.first;
    for (int b = p.diagonal_blocks - 1; b >= 0; --b) {
        const Vec* l = p.vectors(b);
        const int n = std::min(L, p.w - L * b);
        Vec x_b[2] = {};
        for (int c = 0; c < n; ++c) {
            const Real rest = mine[L * b + c] - panel::sum_lanes<Real>(products[L * b + c]);
            x_b[c % 2] += panel::up_to_lane<Real>(l[L * b + c], c) * rest;
        }
        const Vec z = x_b[0] + x_b[1];
        for (int c = 0; c < n; ++c) mine[L * b + c] = z[c];
        for (int c = 0; c < L * b; ++c) products[c] += l[c] * z;
    }
}

template <class Real>
void SupernodalFactor<Real>::solve(Real* x) const {
    const FlushDenormals scope;
    const int n = static_cast<int>(shape_->list().size());
    for (int s = 0; s < n; ++s) solve_forward(s, x);
    for (int s = n - 1; s >= 0; --s) solve_backward(s, x);
}

template void SupernodalFactor<float>::solve(float*) const;
template void SupernodalFactor<double>::solve(double*) const;

}  // namespace arcsim
