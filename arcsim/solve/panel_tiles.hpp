#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

/// Dense kernels of the supernodal factorisation, in registers, for one panel layout.
///
/// A panel's rows are cut into blocks of `lanes` rows; a block stores its columns one after another, each one vector
/// register wide. A kernel then reads a few contiguous streams, whatever the panel's size: nothing is packed or copied,
/// and small panels run like large ones. Tiles of 3 row blocks x `tile_columns` columns fill the register file.
namespace arcsim::panel {

// Vectors wider than a register are passed among these inline functions only: their calling convention is nobody's concern.
#pragma GCC diagnostic ignored "-Wpsabi"

#if defined(__AVX512F__)
inline constexpr int vector_bytes = 64, tile_columns = 8;
#else   // without AVX the compiler makes each of two registers: four doubles hold a tile's columns
inline constexpr int vector_bytes = 32, tile_columns = 4;
#endif
inline constexpr int tile_blocks = 3;

template <class Real>
using Vec [[gnu::vector_size(vector_bytes)]] = Real;
template <class Real>
inline constexpr int lanes = vector_bytes / static_cast<int>(sizeof(Real));

/// acc -= A Bᵀ: R row blocks (each k columns from a[r] on) times C rows of another block (first column at b).
template <class Real, int R, int C>
inline void subtract_product(const Vec<Real>* const (&a)[R], const Real* b, int k, Vec<Real> (&acc)[R][C]) {
    for (int j = 0; j < k; ++j, b += lanes<Real>) {
        Vec<Real> x[R];
        for (int r = 0; r < R; ++r) x[r] = a[r][j];
        for (int c = 0; c < C; ++c)
            for (int r = 0; r < R; ++r) acc[r][c] -= x[r] * b[c];
    }
}

/// The factor of a tile's own C x C diagonal part, its diagonal inverted.
template <class Real, int C>
struct Triangle {
    Real l[C][C];
    Real inverse[C];
};

/// acc = acc L⁻ᵀ.
template <class Real, int R, int C>
inline void solve_triangle(const Triangle<Real, C>& t, Vec<Real> (&acc)[R][C]) {
    for (int c = 0; c < C; ++c)
        for (int r = 0; r < R; ++r) {
            acc[r][c] *= t.inverse[c];
            for (int d = c + 1; d < C; ++d) acc[r][d] -= acc[r][c] * t.l[d][c];
        }
}

/// Calls f.template operator()<C>() for the C in 1 .. tile_columns that n is.
template <int C = tile_columns, class F>
inline void with_columns(int n, F&& f) {
    if constexpr (C == 1)
        f.template operator()<1>();
    else if (n >= C)
        f.template operator()<C>();
    else
        with_columns<C - 1>(n, f);
}

/// Calls f.template operator()<R>(first) over row blocks first .. last - 1, three at a time while there are three.
template <class F>
inline void for_row_blocks(int first, int last, F&& f) {
    for (; first + 3 <= last; first += 3) f.template operator()<3>(first);
    if (last - first == 2) f.template operator()<2>(first);
    if (last - first == 1) f.template operator()<1>(first);
}

/// base[to[i]] += value[i] at lanes first .. last - 1; the places differ.
template <class Real>
inline void scatter_add(Real* base, const std::int32_t* to, const Vec<Real>& value, int first, int last) {
#if defined(__AVX512F__)
    const unsigned mask = (0xffffu >> (16 - last)) & (0xffffu << first);
    if constexpr (sizeof(Real) == 4) {
        const __m512i at = _mm512_loadu_si512(to);
        const __m512 old = _mm512_mask_i32gather_ps(_mm512_setzero_ps(), static_cast<__mmask16>(mask), at, base, 4);
        _mm512_mask_i32scatter_ps(base, static_cast<__mmask16>(mask), at, old + value, 4);
    } else {
        const __m256i at = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(to));
        const __m512d old = _mm512_mask_i32gather_pd(_mm512_setzero_pd(), static_cast<__mmask8>(mask), at, base, 8);
        _mm512_mask_i32scatter_pd(base, static_cast<__mmask8>(mask), at, old + value, 8);
    }
#else
    for (int i = first; i < last; ++i) base[to[i]] += value[i];
#endif
}

template <class Real>
using Indices [[gnu::vector_size(vector_bytes)]] = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;

/// 0, 1, 2, ...
template <class Real>
inline Indices<Real> lane_numbers() {
    Indices<Real> lane;
    for (int i = 0; i < lanes<Real>; ++i) lane[i] = i;
    return lane;
}

/// v at lanes c and later, zero before; and at lanes up to c, zero after.
template <class Real>
inline Vec<Real> from_lane(const Vec<Real>& v, int c) {
    return lane_numbers<Real>() >= c ? v : Vec<Real>{};
}
template <class Real>
inline Vec<Real> up_to_lane(const Vec<Real>& v, int c) {
    return lane_numbers<Real>() <= c ? v : Vec<Real>{};
}

template <class Real>
inline Real sum_lanes(Vec<Real> v) {
    for (int half = lanes<Real> / 2; half > 0; half /= 2) v += __builtin_shuffle(v, lane_numbers<Real>() ^ half);
    return v[0];
}

}  // namespace arcsim::panel
