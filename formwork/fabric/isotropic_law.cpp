#include "formwork/fabric/isotropic_law.hpp"

#include <cmath>

namespace formwork {

using arcsim::all_lanes;
using arcsim::larger;
using arcsim::smaller;
using arcsim::select;
using arcsim::square_root;

namespace {

/// Below this difference of principal strains their directions are noise and quotients by it are replaced by
/// their limits, which are off by as little.
constexpr double tiny_difference = 1e-8;

/// The symmetric 2x2 matrix without its negative part.
void drop_negative_part(Lanes& a, Lanes& b, Lanes& d) {   // [[a, b], [b, d]]
    const Lanes m = 0.5 * (a + d), h = 0.5 * (a - d), r = square_root(h * h + b * b);
    const Lanes high = larger(m + r, Lanes{}), low = larger(m - r, Lanes{});
    const Lanes safe = select(r > 0, r, all_lanes(1));
    const Lanes mean = 0.5 * (high + low), half = 0.5 * (high - low) / safe;
    a = mean + half * h;
    d = mean - half * h;
    b = half * b;
}

}  // namespace

IsotropicMembrane::IsotropicMembrane(const MaterialParams& p)
    : MembraneLaw(p.compression == Compression::tension_field),
      k0_(p.stretching_mult * p.rest[0]), k1_(p.stretching_mult * p.max[0]), q0_(p.stretching_mult * p.rest[1]),
      q1_(p.stretching_mult * p.max[1]), range_(p.max_stretch - 1) {
    const bool constant = k0_ == k1_ && q0_ == q1_;
    separable_ = p.law == IsotropicLaw::separable || constant;
    if (separable_) q1_ = q0_;
}

IsotropicMembrane::Stiffness IsotropicMembrane::stiffness(const Lanes& e) const {
    const Lanes lambda = square_root(larger(1 + 2 * e, all_lanes(1e-12)));
    const Lanes t = (2 * e / (1 + lambda)) / range_;           // (lambda - 1) / range without cancellation
    const auto inside = (t > 0) & (t < 1);
    const Lanes s = smaller(larger(t, Lanes{}), all_lanes(1));
    const Lanes ds = select(inside, 1 / (range_ * lambda), Lanes{});
    return {k0_ + (k1_ - k0_) * s, (k1_ - k0_) * ds, q0_ + (q1_ - q0_) * s, (q1_ - q0_) * ds};
}

/// psi(e), by the stretch u = lambda - 1: a polynomial, so that nothing cancels at small strains.
Lanes IsotropicMembrane::potential(const Lanes& e) const {
    const Lanes lambda = square_root(larger(1 + 2 * e, all_lanes(1e-12)));
    const Lanes u = smaller(2 * e / (1 + lambda), all_lanes(range_));
    const double slope = (k1_ - k0_) / range_;
    const Lanes rising = u * u * (k0_ * (0.5 + u * (0.5 + 0.125 * u)) + slope * u * (1. / 3 + u * (0.375 + 0.1 * u)));
    const double e_max = range_ * (1 + 0.5 * range_);
    const Lanes beyond = select(e > e_max, 0.5 * k1_ * (e - e_max) * (e + e_max), Lanes{});
    return select(e > 0, rising + beyond, 0.5 * k0_ * e * e);
}

void IsotropicMembrane::evaluate(const StrainLanes& e, Want want, StressLanes& out) const {
    const Lanes m = 0.5 * (e.uu + e.vv), d = 0.5 * (e.uu - e.vv);
    const Lanes R = square_root(d * d + e.uv * e.uv);
    const auto split = R > tiny_difference;
    const Lanes safe_R = select(R > 0, R, all_lanes(1));
    const Lanes c2 = select(R > 0, d / safe_R, all_lanes(1)), s2 = e.uv / safe_R;   // of twice the angle
    const Lanes e1 = m + R, e2 = m - R;

    // The whole law: stresses and D = dS_i/de_j.
    const Stiffness a = stiffness(e1);
    Lanes S1, S2, D11, D12, D21, D22, G;
    if (separable_) {
        const Stiffness b = stiffness(e2);
        S1 = a.k * e1 + q0_ * e2;
        S2 = b.k * e2 + q0_ * e1;
        D11 = a.k + a.dk * e1;
        D22 = b.k + b.dk * e2;
        D12 = D21 = all_lanes(q0_);
        G = select(split, (S1 - S2) / (4 * safe_R), 0.5 * (D11 - q0_));
    } else {
        S1 = a.k * e1 + a.q * e2;
        S2 = a.k * e2 + a.q * e1;
        D11 = a.k + a.dk * e1 + a.dq * e2;
        D12 = a.q;
        D21 = a.q + a.dk * e2 + a.dq * e1;
        D22 = a.k;
        G = 0.5 * (a.k - a.q);
    }
    Lanes psi{};
    if (want == Want::energy && separable_) psi = potential(e1) + potential(e2) + q0_ * e1 * e2;

    if (tension_field_) {
        const double r = regulariser_.r;
        const auto slack = e1 <= 0;
        const auto wrinkled = (S2 < 0) & ~slack;
        // Wrinkled: the width contracts freely, e2 -> -q e1 / k.
        const Lanes k = separable_ ? all_lanes(k0_) : a.k, q = a.q;
        const Lanes W1 = a.k * e1 - q * q * e1 / k;
        const Lanes dW1 = a.k + a.dk * e1 - (q * q + 2 * q * a.dq * e1) / k +
                          (separable_ ? Lanes{} : q * q * e1 * a.dk / (k * k));
        const Lanes WG = W1 / (4 * safe_R);
        const auto relax = [&](Lanes& full, const Lanes& relaxed) {
            full = select(slack, r * full, select(wrinkled, r * full + (1 - r) * relaxed, full));
        };
        const Lanes zero{};
        relax(S1, W1);
        relax(S2, zero);
        relax(D11, dW1);
        relax(D12, zero);
        relax(D21, zero);
        relax(D22, zero);
        relax(G, WG);
        if (want == Want::energy && separable_) relax(psi, potential(e1) - 0.5 * q0_ * q0_ * e1 * e1 / k0_);
    }
    const double Tp = regulariser_.Tp;
    const Lanes mean = 0.5 * (S1 + S2) + Tp, half = 0.5 * (S1 - S2);
    out.uu = mean + half * c2;
    out.vv = mean - half * c2;
    out.uv = half * s2;
    if (want == Want::energy) out.psi = psi + 2 * Tp * m;
    if (want != Want::tangent && want != Want::definite_tangent) return;

    Lanes Ds = 0.5 * (D12 + D21), Da = 0.5 * (D12 - D21);
    if (want == Want::definite_tangent) {
        drop_negative_part(D11, Ds, D22);
        G = larger(G, Lanes{});
        Da = Lanes{};
    }
    // C = sum D_ij N_i N_j^T + G M M^T; N1 = (A, B, h), N2 = (B, A, -h), M = (-2h, 2h, c2)
    const Lanes A = 0.5 * (1 + c2), B = 0.5 * (1 - c2), h = 0.5 * s2;
    const Lanes hh = h * h, AB = A * B;
    out.C[0] = D11 * A * A + D22 * B * B + 2 * Ds * AB + 4 * G * hh;
    out.C[1] = (D11 + D22) * AB + Ds * (A * A + B * B) - 4 * G * hh;
    out.C[2] = h * (D11 * A - D22 * B + Ds * (B - A) - 2 * G * c2);
    out.C[3] = D11 * B * B + D22 * A * A + 2 * Ds * AB + 4 * G * hh;
    out.C[4] = h * (D11 * B - D22 * A + Ds * (A - B) + 2 * G * c2);
    out.C[5] = hh * (D11 + D22 - 2 * Ds) + G * c2 * c2;
    out.skew[0] = Da * c2;
    out.skew[1] = -Da * h;
    out.skew[2] = -Da * h;
}

FaceState IsotropicMembrane::state(const Vector3d& eps) const {
    const double m = 0.5 * (eps[0] + eps[1]), R = std::hypot(0.5 * (eps[0] - eps[1]), eps[2]);
    const double e1 = m + R, e2 = m - R;
    if (e1 <= 0) return FaceState::slack;
    const Stiffness a = stiffness(all_lanes(e1)), b = stiffness(all_lanes(e2));
    const double S2 = (separable_ ? b.k[0] : a.k[0]) * e2 + a.q[0] * e1;
    return S2 < 0 ? FaceState::wrinkled : FaceState::taut;
}

Vector3d IsotropicMembrane::fabric_strain(const Vector3d& eps) const {
    const FaceState s = tension_field_ ? state(eps) : FaceState::taut;
    if (s == FaceState::slack) return Vector3d::Zero();
    if (s == FaceState::taut) return eps;
    const double R = std::hypot(0.5 * (eps[0] - eps[1]), eps[2]), e1 = 0.5 * (eps[0] + eps[1]) + R;
    const Stiffness a = stiffness(all_lanes(e1));
    const double e2 = -a.q[0] * e1 / (separable_ ? k0_ : a.k[0]);
    const double mean = 0.5 * (e1 + e2), half = 0.5 * (e1 - e2) / R;   // a wrinkled face has e1 > 0 > e2
    const double c2 = 0.5 * (eps[0] - eps[1]);
    return {mean + half * c2, mean - half * c2, half * eps[2]};
}

}  // namespace formwork
