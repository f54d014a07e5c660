#include "formwork/load/pressure_force.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "arcsim/base/block_lanes.hpp"
#include "formwork/load/wet_part.hpp"

namespace formwork {

using arcsim::AllBlockLanes;
using arcsim::Half;
using arcsim::Lanes;
using arcsim::all_lanes;
using arcsim::Matrix3d;
using arcsim::n_lanes;

/// Corners, area vector, depths and wet weights of eight faces.
struct PressureForce::Lanes3 {
    int node[3][n_lanes];
    Lanes x[3][3];    // [corner][axis]
    Lanes N[3];
    Lanes W[3][3];
    Lanes P[3];       // pressure integral of each corner, per area: f_a = P_a N
};

PressureForce::PressureForce(std::vector<Triangle> faces, const Vector3d& up, double rho_g, double overpressure,
                             PressureQuadrature quadrature, PressureJacobian jacobian)
    : faces_(std::move(faces)), up_(up.normalized()), rho_g_(rho_g), overpressure_(overpressure),
      quadrature_(quadrature), jacobian_(jacobian) {}

Matrix3d PressureForce::weights(const Vector3d& q) const {
    if (quadrature_ == PressureQuadrature::consistent) return wet_part(q);
    Matrix3d W = Matrix3d::Zero();
    for (int a = 0; a < 3; ++a) W(a, a) = q[a] > 0 ? 1. / 3 : 0;
    return W;
}

Vector3d PressureForce::heights(const VectorXd& x, const Triangle& t) const {
    return {x.segment<3>(3 * t[0]).dot(up_), x.segment<3>(3 * t[1]).dot(up_), x.segment<3>(3 * t[2]).dot(up_)};
}

Vector3d PressureForce::area_vector(const VectorXd& x, const Triangle& t) const {
    const Vector3d a = x.segment<3>(3 * t[0]);
    return 0.5 * orientation_ * (x.segment<3>(3 * t[1]) - a).cross(Vector3d(x.segment<3>(3 * t[2]) - a));
}

template <bool gradient, bool hessian>
void PressureForce::assemble(const State& s, VectorXd* g, BlockMatrix* H) const {
    const int n_faces = static_cast<int>(faces_.size());
    const double rho_g = this->rho_g(), p0 = overpressure();
    const bool with_skew = hessian && H->is_general();
    Lanes3 k;
    AllBlockLanes B, A;
    for (int first = 0; first < n_faces; first += n_lanes) {
        const int n = std::min(n_lanes, n_faces - first);
        bool all_wet = true, any_wet = false;
        Vector3d q[n_lanes];
        for (int l = 0; l < n_lanes; ++l) {
            const Triangle& t = faces_[first + std::min(l, n - 1)];
            for (int a = 0; a < 3; ++a) {
                k.node[a][l] = t[a];
                double height = 0;
                for (int c = 0; c < 3; ++c) {
                    const double v = s.x[3 * t[a] + c];
                    k.x[a][c][l] = v;
                    height += v * up_[c];
                }
                q[l][a] = level_ - height;
                (q[l][a] > 0 ? any_wet : all_wet) = q[l][a] > 0;
            }
        }
        if (!any_wet && p0 == 0) continue;
        if (all_wet && quadrature_ == PressureQuadrature::consistent) {
            for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 3; ++b) k.W[a][b] = all_lanes(a == b ? 1. / 6 : 1. / 12);
        } else {
            for (int l = 0; l < n_lanes; ++l) {
                const Matrix3d W = weights(q[l]);
                for (int a = 0; a < 3; ++a)
                    for (int b = 0; b < 3; ++b) k.W[a][b][l] = W(a, b);
            }
        }
        Lanes depth[3];
        for (int a = 0; a < 3; ++a)
            depth[a] = level_ - (k.x[a][0] * up_[0] + k.x[a][1] * up_[1] + k.x[a][2] * up_[2]);
        for (int a = 0; a < 3; ++a)
            k.P[a] = rho_g * (k.W[a][0] * depth[0] + k.W[a][1] * depth[1] + k.W[a][2] * depth[2]) + p0 / 3;
        for (int c = 0; c < 3; ++c) {
            const int d = (c + 1) % 3, e = (c + 2) % 3;
            k.N[c] = 0.5 * orientation_ *
                     ((k.x[1][d] - k.x[0][d]) * (k.x[2][e] - k.x[0][e]) -
                      (k.x[1][e] - k.x[0][e]) * (k.x[2][d] - k.x[0][d]));
        }
        if constexpr (gradient)
            for (int a = 0; a < 3; ++a)
                for (int c = 0; c < 3; ++c) {
                    const Lanes f = k.P[a] * k.N[c];
                    for (int l = 0; l < n; ++l) (*g)[3 * k.node[a][l] + c] -= f[l];
                }
        if constexpr (hessian) {
            // H_ab = rho g W_ab N d^T - P_a/2 [opp_b]_x
            const auto entry = [&](int a, int b, int r, int c) -> Lanes {
                if (jacobian_ == PressureJacobian::lumped) {
                    if (a != b) return Lanes{};
                    Lanes wet;
                    for (int l = 0; l < n_lanes; ++l) wet[l] = q[l][a] > 0 ? rho_g / 3 : 0;
                    return wet * k.N[r] * up_[c];
                }
                Lanes h = rho_g * k.W[a][b] * k.N[r] * up_[c];
                if (r == c) return h;
                const int axis = 3 - r - c;                                  // [w]_x (r, c) = -+ w_axis
                const double sign = (c - r + 3) % 3 == 1 ? -1 : 1;
                const Lanes w = k.x[(b + 2) % 3][axis] - k.x[(b + 1) % 3][axis];
                return h - (0.5 * orientation_ * sign) * k.P[a] * w;
            };
            for (int pair = 0; pair < 3; ++pair) {
                const int a = pair, b = (pair + 1) % 3;
                for (int c = 0; c < 3; ++c)
                    for (int r = 0; r < 3; ++r) {
                        const Lanes ab = entry(a, b, r, c), ba = entry(b, a, c, r);
                        const Lanes aa = entry(a, a, r, c), at = entry(a, a, c, r);
                        B.pair[pair][r + 3 * c] = 0.5 * (ab + ba);
                        B.diagonal[a][r + 3 * c] = 0.5 * (aa + at);
                        A.pair[pair][r + 3 * c] = 0.5 * (ab - ba);
                        A.diagonal[a][r + 3 * c] = 0.5 * (aa - at);
                    }
            }
            scatter(B, Half::symmetric, k.node, first, n, *pattern_, H->values());
            if (with_skew) scatter(A, Half::antisymmetric, k.node, first, n, *pattern_, H->skew_values());
        }
    }
}

void PressureForce::add_gradient(const State& s, VectorXd& g) const {
    if (presses()) assemble<true, false>(s, &g, nullptr);
}

void PressureForce::add_hessian(const State& s, Tangent t, BlockMatrix& H) const {
    if (presses() && t == Tangent::exact && jacobian_ != PressureJacobian::none) assemble<false, true>(s, nullptr, &H);
}

void PressureForce::add_gradient_and_hessian(const State& s, Tangent t, VectorXd& g, BlockMatrix& H) const {
    if (t == Tangent::definite || jacobian_ == PressureJacobian::none) return add_gradient(s, g);
    if (presses()) assemble<true, true>(s, &g, &H);
}

std::optional<double> PressureForce::energy(const State& s) const {
    if (quadrature_ == PressureQuadrature::lumped) return std::nullopt;
    double E = 0;
    for (const Triangle& t : faces_) {
        const Vector3d z = heights(s.x, t), q = Vector3d::Constant(level_) - z;
        const double n_d = area_vector(s.x, t).dot(up_);
        E += n_d * (0.5 * rho_g() * q.dot(wet_part(q) * q) - overpressure() * (z.mean() - z_ref_));
    }
    return E;
}

LiquidTotals PressureForce::totals(const VectorXd& x, double level) const {
    LiquidTotals r;
    for (const Triangle& t : faces_) {
        const Vector3d q = Vector3d::Constant(level) - heights(x, t);
        if (q.maxCoeff() <= 0) continue;
        const Matrix3d W = weights(q);
        const double n_d = area_vector(x, t).dot(up_);
        r.volume -= n_d * (W * q).sum();
        r.waterplane -= n_d * W.sum();
    }
    return r;
}

void PressureForce::level_derivative(const VectorXd& x, VectorXd& b) const {
    b.setZero(x.size());
    for (const Triangle& t : faces_) {
        const Vector3d q = Vector3d::Constant(level_) - heights(x, t);
        if (q.maxCoeff() <= 0) continue;
        const Vector3d share = weights(q).rowwise().sum(), N = area_vector(x, t);
        for (int a = 0; a < 3; ++a) b.segment<3>(3 * t[a]) += rho_g() * share[a] * N;
    }
}

}  // namespace formwork
