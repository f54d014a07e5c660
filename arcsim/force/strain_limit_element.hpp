#pragma once

#include <Eigen/Core>
#include <cmath>

#include "arcsim/base/types.hpp"

/// Symmetric 2x2 matrices T as vectors (T_uu, T_vv, T_uv), for limits of the principal strains of a face.
namespace arcsim::limit {

/// T₊: T without its negative eigenvalues, the nearest matrix that has none; and dT₊/dT, where T_uv stands
/// for both entries off the diagonal.
struct PositivePart {
    Vector3d value = Vector3d::Zero();
    Matrix3d derivative = Matrix3d::Zero();
};

/// With eigenvalues λ1 > 0 > λ2 and eigenvectors n, m:
///
///   T₊ = λ1 N,   dT₊ = N (N : dT) + 2 λ1/(λ1 - λ2) M (M : dT),   N = n nᵀ, M = (n mᵀ + m nᵀ)/2
inline PositivePart positive_part_of(const Vector3d& T) {
    const double mean = 0.5 * (T[0] + T[1]), d = 0.5 * (T[0] - T[1]), r = std::hypot(d, T[2]);
    if (mean + r <= 0) return {};                                 // T = 0, too: no bound pushes there
    if (mean >= r) return {T, Matrix3d::Identity()};
    const double c = d / r, s = T[2] / r;                         // of twice the angle of n
    const Vector3d N(0.5 * (1 + c), 0.5 * (1 - c), 0.5 * s), M(-0.5 * s, 0.5 * s, 0.5 * c);
    const Vector3d weight(1, 1, 2);                               // T_uv appears twice in N : dT
    const double lambda = mean + r;
    return {lambda * N, N * weight.cwiseProduct(N).transpose() + lambda / r * M * weight.cwiseProduct(M).transpose()};
}

/// Frobenius.
inline double squared_norm(const Vector3d& T) { return T[0] * T[0] + T[1] * T[1] + 2 * T[2] * T[2]; }

}  // namespace arcsim::limit
