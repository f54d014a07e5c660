#include "formwork/fabric/tensor_wrinkle.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>

namespace formwork {
namespace {

using std::numbers::pi;

/// Voigt vectors of n n^T (strain measure), and of the symmetric t n^T.
Vector3d normal_normal(double c, double s) { return {s * s, c * c, -2 * s * c}; }      // n = (-s, c)
Vector3d tension_normal(double c, double s) { return {-c * s, s * c, c * c - s * s}; }

/// w(a) and its first two derivatives for compliance s11, s12, s22, s66.
struct Objective {
    double v0, v1, v2;              // strain (e_uu, e_vv, 2 e_uv)
    double s11, s12, s22, s66;      // m/N

    struct Value {
        double e, w, dw, ddw;
        double up;   // sign: where larger w with e > 0 lies
    };
    Value at(double a) const {
        const double c = std::cos(a), s = std::sin(a);
        const double C = c * c, S = s * s, P = c * s, D = C - S;
        const double e = C * v0 + S * v1 + P * v2;
        const double de = 2 * P * (v1 - v0) + D * v2;
        const double dde = 2 * D * (v1 - v0) - 4 * P * v2;
        const double b = 2 * s12 + s66;
        const double q = s11 * C * C + s22 * S * S + b * P * P;   // N.s N
        const double dq = -4 * s11 * C * P + 4 * s22 * S * P + 2 * b * P * D;
        const double ddq = s11 * (8 * P * P - 4 * C * D) + s22 * (8 * P * P + 4 * S * D) + 2 * b * (D * D - 4 * P * P);
        Value r;
        r.e = e;
        r.w = e * e / (2 * q);
        r.dw = e * de / q - e * e * dq / (2 * q * q);
        r.ddw = (de * de + e * dde) / q - 2 * e * de * dq / (q * q) - e * e * ddq / (2 * q * q) +
                e * e * dq * dq / (q * q * q);
        r.up = e > 0 ? r.dw : de;
        return r;
    }
};

double scan_cos(int i) {
    static const std::array<double, 24> table = [] {
        std::array<double, 24> t;
        for (int k = 0; k < 24; ++k) t[k] = std::cos(pi * k / 24);
        return t;
    }();
    return table[i];
}
double scan_sin(int i) { return i <= 12 ? scan_cos(12 - i) : scan_cos(i - 12); }

/// Newton's method inside the bracket start -+ width; `top` gets the angle of the maximum of w where e > 0.
/// @returns twice w there; 0 when e is never positive
double climb(const Objective& f, double start, double width, double& top) {
    double low = start - width, high = start + width, a = start;
    Objective::Value v = f.at(a);
    for (int i = 0; i < 60; ++i) {
        (v.up > 0 ? low : high) = a;
        double next = a - v.dw / v.ddw;
        const bool by_newton = v.e > 0 && v.ddw < 0 && next > low && next < high;
        if (!by_newton) next = 0.5 * (low + high);
        constexpr double last_step = 1e-10;   // of Newton's: the error after it is about its square
        const bool done = (by_newton && std::abs(next - a) < last_step) || high - low < 1e-15;
        a = next;
        if (done) break;
        v = f.at(a);
    }
    top = a;
    return v.e > 0 ? 2 * v.w : 0;
}

}  // namespace

Vector3d with_wrinkle(const Vector3d& eps, const Wrinkle& w) {
    const double c = std::cos(w.a), s = std::sin(w.a);
    return {eps[0] + w.p * s * s, eps[1] + w.p * c * c, eps[2] - w.p * s * c};
}

Wrinkle wrinkle_of_constant(const arcsim::Stiffness4& k, const Vector3d& eps) {
    const double kuu = k[0], kuv = k[1], kvv = k[2], kss = k[3];
    const double det = kuu * kvv - kuv * kuv;
    const Objective f{eps[0], eps[1], 2 * eps[2], kvv / det, -kuv / det, kuu / det, 2 / kss};

    // Every maximum that shows among the samples is followed to its top. Where no sample has e > 0, the range of angles with
    // e > 0 is narrow, and about the principal direction of strain.
    constexpr int n_scan = 24;
    double w_at[n_scan];
    for (int i = 0; i < n_scan; ++i) {
        const double c = scan_cos(i), s = scan_sin(i), C = c * c, S = s * s, P = c * s;
        const double e = C * f.v0 + S * f.v1 + P * f.v2;
        const double q = f.s11 * C * C + f.s22 * S * S + (2 * f.s12 + f.s66) * P * P;
        w_at[i] = e > 0 ? e * e / q : 0;
    }
    double a = 0, best_w = 0;
    for (int i = 0; i < n_scan; ++i) {
        const double before = w_at[(i + n_scan - 1) % n_scan], after = w_at[(i + 1) % n_scan];
        if (!(w_at[i] > 0 && w_at[i] >= before && w_at[i] > after)) continue;
        double top = 0;
        if (const double w = climb(f, pi * i / n_scan, pi / n_scan, top); w > best_w) best_w = w, a = top;
    }
    if (best_w == 0) {
        a = 0.5 * std::atan2(2 * eps[2], eps[0] - eps[1]);
        climb(f, a, pi / n_scan, a);
    }
    const double c = std::cos(a), s = std::sin(a);
    const Vector3d N(c * c, s * s, c * s);
    Wrinkle w;
    w.a = a;
    const Vector3d sN(f.s11 * N[0] + f.s12 * N[1], f.s12 * N[0] + f.s22 * N[1], f.s66 * N[2]);
    w.sigma = N.dot(Vector3d(f.v0, f.v1, f.v2)) / N.dot(sN);
    // The strain across t: what the stress asks for, less what there is. Voigt shear is twice the tensor's.
    const Vector3d more = w.sigma * sN - Vector3d(f.v0, f.v1, f.v2);
    w.p = s * s * more[0] + c * c * more[1] - s * c * more[2];
    return w;
}

Matrix3d wrinkle_tangent(const TensorStress& at, const Wrinkle& w, const Vector3d& e,
                         const Eigen::Matrix<double, 4, 3>& dk) {
    const double c = std::cos(w.a), s = std::sin(w.a);
    const Vector3d Vn = normal_normal(c, s), Vt = tension_normal(c, s);
    const Vector3d CVn = at.C * Vn, CVt = at.C * Vt;
    arcsim::Matrix2d J;
    J << Vn.dot(CVn), -2 * w.p * Vn.dot(CVt),   //
        Vt.dot(CVn), -2 * w.p * Vt.dot(CVt) - w.sigma;
    // What changes S at fixed p and a: the strain, and with it the stiffness.
    Matrix3d direct = at.C;
    direct.row(0) += e[0] * dk.row(0) + e[1] * dk.row(1);
    direct.row(1) += e[1] * dk.row(2) + e[0] * dk.row(1);
    direct.row(2) += e[2] * dk.row(3);
    Eigen::Matrix<double, 2, 3> rhs;
    rhs.row(0) = -Vn.transpose() * direct;
    rhs.row(1) = -Vt.transpose() * direct;
    const Eigen::Matrix<double, 2, 3> d = J.inverse() * rhs;   // det < 0: w'' < 0 at the maximum
    return direct + CVn * d.row(0) - 2 * w.p * CVt * d.row(1);
}

}  // namespace formwork
