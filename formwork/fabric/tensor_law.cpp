#include "formwork/fabric/tensor_law.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "formwork/fabric/tensor_wrinkle.hpp"

namespace formwork {
namespace {

using arcsim::Stiffness4;

Vector3d stress(const Stiffness4& k, const Vector3d& e) {
    return {k[0] * e[0] + k[1] * e[1], k[2] * e[1] + k[1] * e[0], k[3] * e[2]};
}

TensorStress stress_and_tangent(const arcsim::StiffnessSample& sample, const Vector3d& e) {
    const Stiffness4& k = sample.k;
    Matrix3d by_G;   // by (e_uu, e_vv, e_uv)
    by_G << k[0], k[1], 0, k[1], k[2], 0, 0, 0, k[3];
    const auto& dk = sample.dk_dG;
    by_G.row(0) += e[0] * dk.row(0) + e[1] * dk.row(1);
    by_G.row(1) += e[1] * dk.row(2) + e[0] * dk.row(1);
    by_G.row(2) += e[2] * dk.row(3);
    by_G.col(2) *= 0.5;
    return {stress(k, e), by_G, k};
}

const Eigen::Matrix<double, 4, 3> no_slope = Eigen::Matrix<double, 4, 3>::Zero();

double larger_principal(const Vector3d& t) { return 0.5 * (t[0] + t[1]) + std::hypot(0.5 * (t[0] - t[1]), t[2]); }
double smaller_principal(const Vector3d& t) { return 0.5 * (t[0] + t[1]) - std::hypot(0.5 * (t[0] - t[1]), t[2]); }

}  // namespace

TensorMembrane::TensorMembrane(const arcsim::StretchingRows& rows, arcsim::Sampling sampling, double multiplier,
                               Compression compression)
    : MembraneLaw(compression == Compression::tension_field), table_(rows, sampling, multiplier) {
    constant_ = std::all_of(rows.begin(), rows.end(), [&](const Stiffness4& r) { return r == rows[0]; });
    constant_sample_.k = table_.rest();
    constant_sample_.dk_dG.setZero();
    rest_stiffness_ = std::max(constant_sample_.k[0], constant_sample_.k[2]);
    largest_stiffness_ = 0;
    for (const Stiffness4& r : rows)
        largest_stiffness_ =
            std::max(largest_stiffness_, multiplier * arcsim::StiffnessTable::file_factor * std::max(r[0], r[2]));
}

void TensorMembrane::evaluate_face(const Vector3d& eps, Want want, FaceStress& out) const {
    const auto law = [this](const Vector3d& e) {
        return stress_and_tangent(constant_ ? constant_sample_ : table_.sample(e), e);
    };
    const bool tangent = want == Want::tangent || want == Want::definite_tangent;
    const TensorStress full = law(eps);
    out.S = full.S;
    out.C = full.C;
    out.psi = 0.5 * (full.S[0] * eps[0] + full.S[1] * eps[1] + 2 * full.S[2] * eps[2]);
    if (tension_field_) {
        const double r = regulariser_.r;
        if (larger_principal(eps) <= 0) {
            out.S *= r;
            out.C *= r;
            out.psi *= r;
        } else if (smaller_principal(full.S) < 0) {
            const Wrinkle w = wrinkle_of_constant(full.k, eps);
            const Vector3d there = with_wrinkle(eps, w);
            const TensorStress relaxed = stress_and_tangent({full.k, no_slope}, there);
            out.S = r * full.S + (1 - r) * relaxed.S;
            if (tangent) {
                Eigen::Matrix<double, 4, 3> dk = constant_ ? no_slope : table_.sample(eps).dk_dG;
                dk.col(2) *= 0.5;
                out.C = r * full.C + (1 - r) * wrinkle_tangent(relaxed, w, there, dk);
            }
            out.psi = r * out.psi + (1 - r) * 0.5 *
                                        (relaxed.S[0] * there[0] + relaxed.S[1] * there[1] +
                                         2 * relaxed.S[2] * there[2]);
        }
    }
    out.S[0] += regulariser_.Tp;
    out.S[1] += regulariser_.Tp;
    out.psi += regulariser_.Tp * (eps[0] + eps[1]);
    if (want == Want::definite_tangent) {
        const Eigen::SelfAdjointEigenSolver<Matrix3d> eig(0.5 * (out.C + out.C.transpose()));
        out.C = eig.eigenvectors() * eig.eigenvalues().cwiseMax(0).asDiagonal() * eig.eigenvectors().transpose();
    }
}

void TensorMembrane::evaluate(const StrainLanes& e, Want want, StressLanes& out) const {
    FaceStress face;
    for (int l = 0; l < arcsim::n_lanes; ++l) {
        evaluate_face({e.uu[l], e.vv[l], e.uv[l]}, want, face);
        out.uu[l] = face.S[0];
        out.vv[l] = face.S[1];
        out.uv[l] = face.S[2];
        out.psi[l] = face.psi;
        const Matrix3d& C = face.C;
        out.C[0][l] = C(0, 0);
        out.C[1][l] = 0.5 * (C(0, 1) + C(1, 0));
        out.C[2][l] = 0.5 * (C(0, 2) + C(2, 0));
        out.C[3][l] = C(1, 1);
        out.C[4][l] = 0.5 * (C(1, 2) + C(2, 1));
        out.C[5][l] = C(2, 2);
        out.skew[0][l] = 0.5 * (C(0, 1) - C(1, 0));
        out.skew[1][l] = 0.5 * (C(0, 2) - C(2, 0));
        out.skew[2][l] = 0.5 * (C(1, 2) - C(2, 1));
    }
}

FaceState TensorMembrane::state(const Vector3d& eps) const {
    if (larger_principal(eps) <= 0) return FaceState::slack;
    return smaller_principal(stress(stiffness(eps), eps)) < 0 ? FaceState::wrinkled : FaceState::taut;
}

Vector3d TensorMembrane::fabric_strain(const Vector3d& eps) const {
    const FaceState s = tension_field_ ? state(eps) : FaceState::taut;
    if (s == FaceState::slack) return Vector3d::Zero();
    return s == FaceState::taut ? eps : with_wrinkle(eps, wrinkle_of_constant(stiffness(eps), eps));
}

}  // namespace formwork
