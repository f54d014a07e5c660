#pragma once

#include "arcsim/base/types.hpp"
#include "arcsim/material/material_data.hpp"

namespace formwork {

using arcsim::Matrix3d;
using arcsim::Vector3d;

/// Stress and tangent of an unrelaxed orthotropic law at one strain; C by (e_uu, e_vv, 2 e_uv).
struct TensorStress {
    Vector3d S;
    Matrix3d C;
    arcsim::Stiffness4 k;
};

/// A face in uniaxial tension: S = sigma t t^T at the strain eps + p n n^T, t = (cos a, sin a), n normal to t.
struct Wrinkle {
    double a = 0;       // rad
    double p = 0;       // wrinkle strain, >= 0
    double sigma = 0;   // N/m
};

/// Constant stiffness k: maximises w(a) = e(a)_+² / (2 c(a)) with e = N.v, c = N.s N, N = (cos², sin², cos sin), s the
/// compliance (tension_field.md 1). Global, since w has up to two maxima.
Wrinkle wrinkle_of_constant(const arcsim::Stiffness4& k, const Vector3d& eps);

/// dS/deps of the wrinkled face by implicit differentiation of n.S n = 0 and t.S n = 0, where S = K(k) (eps + p n n^T).
/// @param K      the constant stiffness matrix of k, by (e_uu, e_vv, 2 e_uv), and the stress at eps + p n n^T
/// @param dk     derivative of k by (e_uu, e_vv, 2 e_uv); zero for a constant table
Matrix3d wrinkle_tangent(const TensorStress& at_wrinkle_strain, const Wrinkle& w, const Vector3d& wrinkle_strain,
                         const Eigen::Matrix<double, 4, 3>& dk);

/// eps + p n n^T.
Vector3d with_wrinkle(const Vector3d& eps, const Wrinkle& w);

}  // namespace formwork
