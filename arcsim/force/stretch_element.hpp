#pragma once

#include <Eigen/Core>

#include "arcsim/base/lanes.hpp"
#include "arcsim/material/stiffness_table.hpp"

/// One triangle of cloth in its plane: u rest, x deformed. With D = [u1-u0, u2-u0] and
/// P = [x1-x0, x2-x0] D^-1 = [x_u, x_v]:
///
///   G = (PᵀP - I)/2                                     Green strain, tensor shear
///   S_uu = k_uu G_uu + k_uv G_vv, S_vv = k_vv G_vv + k_uv G_uu, S_uv = k_ss G_uv      N/m
///   f_i = -A (a_i (S_uu x_u + S_uv x_v) + b_i (S_uv x_u + S_vv x_v))                  N
///
/// a_i, b_i: derivative of x_u, x_v by corner i; A the whole rest area (no third: the gradient of a face's
/// energy already belongs to one corner). Templates on T run for one face or for eight.
namespace arcsim::stretch {

template <class T>
struct Shape {            // a_i and b_i of corners 1 and 2; corner 0 has minus their sum
    T a1, a2, b1, b2;
};

inline Shape<double> shape_of(const Matrix2d& D_inverse) {
    return {D_inverse(0, 0), D_inverse(1, 0), D_inverse(0, 1), D_inverse(1, 1)};
}

template <class T>
struct Strain {
    T xu[3], xv[3];
    T uu, vv, uv;
};

/// @param e1, e2  x1 - x0 and x2 - x0
template <class T>
inline Strain<T> strain(const Shape<T>& s, const T (&e1)[3], const T (&e2)[3]) {
    Strain<T> r;
    for (int c = 0; c < 3; ++c) {
        r.xu[c] = s.a1 * e1[c] + s.a2 * e2[c];
        r.xv[c] = s.b1 * e1[c] + s.b2 * e2[c];
    }
    r.uu = 0.5 * (r.xu[0] * r.xu[0] + r.xu[1] * r.xu[1] + r.xu[2] * r.xu[2] - 1.0);
    r.vv = 0.5 * (r.xv[0] * r.xv[0] + r.xv[1] * r.xv[1] + r.xv[2] * r.xv[2] - 1.0);
    r.uv = 0.5 * (r.xu[0] * r.xv[0] + r.xu[1] * r.xv[1] + r.xu[2] * r.xv[2]);
    return r;
}

template <class T>
struct Stress {
    T uu, vv, uv;
};

template <class T>
inline Stress<T> stress(const Strain<T>& G, const T (&k)[4]) {
    return {k[0] * G.uu + k[1] * G.vv, k[2] * G.vv + k[1] * G.uu, k[3] * G.uv};
}

/// A dE/dx of corners 1 and 2 (minus the forces); corner 0 has minus their sum.
template <class T>
inline void gradient(const Shape<T>& s, const Strain<T>& G, const Stress<T>& S, T area, T (&g1)[3], T (&g2)[3]) {
    for (int c = 0; c < 3; ++c) {
        const T pu = area * (S.uu * G.xu[c] + S.uv * G.xv[c]);
        const T pv = area * (S.uv * G.xu[c] + S.vv * G.xv[c]);
        g1[c] = s.a1 * pu + s.b1 * pv;
        g2[c] = s.a2 * pu + s.b2 * pv;
    }
}

/// Coefficients that the 3x3 blocks of the definite tangent share, each times the rest area and a weight:
///
///   H_ij = (k_uu aa + k_ss/2 bb) x_u x_uᵀ + (k_vv bb + k_ss/2 aa) x_v x_vᵀ
///        + (k_uv ab + k_ss/2 ba) x_u x_vᵀ + (k_uv ba + k_ss/2 ab) x_v x_uᵀ
///        + (aa (k_uu G_uu⁺ + k_uv G_vv⁺) + bb (k_vv G_vv⁺ + k_uv G_uu⁺)) I
///
/// with aa = a_i a_j, ab = a_i b_j, ba = b_i a_j, bb = b_i b_j and + the positive part. ArcSim's: drops
/// dk/dG, the geometric shear term and the geometric stiffness of compressed directions.
template <class T>
struct Coefficients {
    T uu, vv, uv, ss;     // stiffnesses; ss is half of k_ss
    T along_a, along_b;   // geometric: of aa and of bb
};

template <class T>
inline Coefficients<T> coefficients(const Strain<T>& G, const T (&k)[4], T weight) {
    const T pu = positive_part(G.uu), pv = positive_part(G.vv);
    return {weight * k[0],
            weight * k[2],
            weight * k[1],
            weight * 0.5 * k[3],
            weight * (k[0] * pu + k[1] * pv),
            weight * (k[2] * pv + k[1] * pu)};
}

/// Block H_ij, entry (r, c) at B[3 c + r].
template <class T>
inline void block(const Strain<T>& G, const Coefficients<T>& k, T ai, T bi, T aj, T bj, T (&B)[9]) {
    const T aa = ai * aj, bb = bi * bj, ab = ai * bj, ba = bi * aj;
    const T cuu = k.uu * aa + k.ss * bb, cvv = k.vv * bb + k.ss * aa;
    const T cuv = k.uv * ab + k.ss * ba, cvu = k.uv * ba + k.ss * ab;
    for (int c = 0; c < 3; ++c) {
        const T u = cuu * G.xu[c] + cuv * G.xv[c];   // factor of x_u in column c
        const T v = cvv * G.xv[c] + cvu * G.xu[c];
        for (int r = 0; r < 3; ++r) B[3 * c + r] = G.xu[r] * u + G.xv[r] * v;
    }
    const T geometric = k.along_a * aa + k.along_b * bb;
    B[0] += geometric;
    B[4] += geometric;
    B[8] += geometric;
}

/// dS/dG of the secant law S = K(G) G, rows and columns uu, vv, uv; unsymmetric where k depends on G.
inline Matrix3d stress_derivative(const Vector3d& G, const StiffnessSample& s) {
    Matrix3d D;
    D << s.k[0], s.k[1], 0, s.k[1], s.k[2], 0, 0, 0, s.k[3];
    D.row(0) += G[0] * s.dk_dG.row(0) + G[1] * s.dk_dG.row(1);
    D.row(1) += G[1] * s.dk_dG.row(2) + G[0] * s.dk_dG.row(1);
    D.row(2) += G[2] * s.dk_dG.row(3);
    return D;
}

/// The derivative of `gradient` as it is, 9x9 by corners; D = dS/dG.
inline Matrix9d exact_hessian(const Shape<double>& s, const Strain<double>& G, const Stress<double>& S,
                              const Matrix3d& D, double area) {
    const double a[3] = {-s.a1 - s.a2, s.a1, s.a2}, b[3] = {-s.b1 - s.b2, s.b1, s.b2};
    const Eigen::Map<const Vector3d> xu(G.xu), xv(G.xv);
    Eigen::Matrix<double, 9, 3> dG;   // column c: gradient of strain c
    for (int i = 0; i < 3; ++i) {
        dG.block<3, 1>(3 * i, 0) = a[i] * xu;
        dG.block<3, 1>(3 * i, 1) = b[i] * xv;
        dG.block<3, 1>(3 * i, 2) = 0.5 * (a[i] * xv + b[i] * xu);
    }
    const Vector3d weight(1, 1, 2);   // S_uv appears twice in S : G
    Matrix9d H = dG * weight.asDiagonal() * D * dG.transpose();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const double g = S.uu * a[i] * a[j] + S.vv * b[i] * b[j] + S.uv * (a[i] * b[j] + b[i] * a[j]);
            H.block<3, 3>(3 * i, 3 * j).diagonal().array() += g;
        }
    return area * H;
}

}  // namespace arcsim::stretch
