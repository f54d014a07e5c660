#pragma once

#include <cmath>
#include <numbers>

#include "arcsim/base/lanes.hpp"

/// The fold between two triangles that share an edge. Corners: 0 and 1 the edge's end nodes, 2 opposite in
/// the face that runs from 0 to 1 (side 0), 3 opposite in the other (side 1).
///
///   theta = atan2(e . (n0 x n1), n0 . n1),  e = unit(x_0 - x_1)
///
/// positive when the sheet folds towards the side its normals point to.
///
///   grad theta:  node 2: n0/h0,  node 3: n1/h1,  end node i: -(w0_i n0/h0 + w1_i n1/h1)
///
/// h height over the edge, w the weights of its foot on the edge. Templates on T: one hinge, eight, or
/// numbers that carry derivatives.
namespace arcsim::hinge {

/// Of the edge: keeps 1/h finite in slivers; ArcSim's.
inline constexpr double min_height = 1e-3;

template <class T>
struct Fold {
    T sine, cosine;          // of theta, times positive factors
    T gradient[4][3];        // 1/m
};

template <class T>
inline T dot(const T (&a)[3], const T (&b)[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
inline void cross(const T (&a)[3], const T (&b)[3], T (&r)[3]) {
    r[0] = a[1] * b[2] - a[2] * b[1];
    r[1] = a[2] * b[0] - a[0] * b[2];
    r[2] = a[0] * b[1] - a[1] * b[0];
}

inline double larger(double a, double b) { return a > b ? a : b; }
inline Lanes larger(Lanes a, Lanes b) { return a > b ? a : b; }

/// @param x  positions of the four corners
template <class T>
inline Fold<T> fold(const T (&x)[4][3]) {
    T e[3], p[3], q[3], n0[3], n1[3];
    for (int c = 0; c < 3; ++c) {
        e[c] = x[0][c] - x[1][c];
        p[c] = x[2][c] - x[1][c];
        q[c] = x[3][c] - x[1][c];
    }
    cross(p, e, n0);   // (x1 - x0) x (x2 - x0): the normal of side 0, twice its area long
    cross(e, q, n1);   // that of side 1
    const T e2 = dot(e, e), length = square_root(e2);
    const T size0 = square_root(dot(n0, n0)), size1 = square_root(dot(n1, n1));
    // Of a face without area the normal has no direction: it is left zero.
    const T unit0 = 1.0 / larger(size0, T{} + 1e-300), unit1 = 1.0 / larger(size1, T{} + 1e-300);
    T across[3];
    cross(n0, n1, across);
    Fold<T> r;
    const T scale = unit0 * unit1;
    r.sine = dot(e, across) * scale / length;
    r.cosine = dot(n0, n1) * scale;
    const T floor = min_height * length;
    const T height0 = larger(size0 / length, floor), height1 = larger(size1 / length, floor);
    const T w0 = dot(p, e) / e2, w1 = dot(q, e) / e2;   // weights of end node 0
    for (int c = 0; c < 3; ++c) {
        const T m0 = n0[c] * unit0 / height0, m1 = n1[c] * unit1 / height1;
        r.gradient[0][c] = -(w0 * m0 + w1 * m1);
        r.gradient[1][c] = -((1.0 - w0) * m0 + (1.0 - w1) * m1);
        r.gradient[2][c] = m0;
        r.gradient[3][c] = m1;
    }
    return r;
}

/// theta plus the whole turns that bring it within pi of the reference.
inline double unwrap(double theta, double reference) {
    constexpr double turn = 2 * std::numbers::pi;
    return theta - turn * std::round((theta - reference) / turn);
}

}  // namespace arcsim::hinge
