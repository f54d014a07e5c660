#pragma once

#include <cmath>

/// Eight doubles that the compiler keeps in vector registers: element loops run over groups of eight
/// elements stored component by component. Kernels are templates on the number type, so the same
/// equations serve one element (double) and eight (Lanes).
namespace arcsim {

inline constexpr int n_lanes = 8;
using Lanes = double __attribute__((vector_size(n_lanes * sizeof(double))));

inline Lanes all_lanes(double v) { return Lanes{v, v, v, v, v, v, v, v}; }
inline Lanes positive_part(Lanes v) { return v > 0 ? v : all_lanes(0); }
inline double positive_part(double v) { return v > 0 ? v : 0; }
inline Lanes square_root(Lanes v) {
    Lanes r;
    for (int i = 0; i < n_lanes; ++i) r[i] = std::sqrt(v[i]);
    return r;
}
inline double square_root(double v) { return std::sqrt(v); }

/// Comparisons give masks for `select`; both sides are always evaluated.
using LaneMask = decltype(Lanes{} < Lanes{});
inline Lanes select(const LaneMask& m, const Lanes& a, const Lanes& b) { return m ? a : b; }
inline Lanes larger(const Lanes& a, const Lanes& b) { return a > b ? a : b; }
inline Lanes smaller(const Lanes& a, const Lanes& b) { return a < b ? a : b; }

/// Groups of eight that hold n elements.
inline int lane_groups(int n) { return (n + n_lanes - 1) / n_lanes; }

}  // namespace arcsim
