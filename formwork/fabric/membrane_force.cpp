#include "formwork/fabric/membrane_force.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "arcsim/base/error.hpp"
#include "arcsim/base/block_lanes.hpp"

namespace formwork {

using arcsim::BlockLanes;
using arcsim::Half;
using arcsim::n_lanes;

struct MembraneForce::Frame {
    Lanes u[3], v[3];   // columns of F
    StrainLanes e;
};

MembraneForce::MembraneForce(const std::vector<Triangle>& faces, const std::vector<FlatTriangle>& flat,
                             std::shared_ptr<MembraneLaw> law)
    : n_faces_(static_cast<int>(faces.size())), law_(std::move(law)) {
    assert(faces.size() == flat.size());
    groups_.resize((n_faces_ + n_lanes - 1) / n_lanes);
    for (int i = 0; i < static_cast<int>(groups_.size()) * n_lanes; ++i) {
        const int f = std::min(i, n_faces_ - 1), l = i % n_lanes;
        Group& g = groups_[i / n_lanes];
        const Vector2d a = flat[f][1] - flat[f][0], b = flat[f][2] - flat[f][0];
        const double det = a[0] * b[1] - a[1] * b[0];
        const double longest = std::max({a.norm(), b.norm(), (b - a).norm()});
        constexpr double flattest = 1e-9;   // height over longest edge: below it 1/det is noise
        if (!(det > flattest * longest * longest))
            throw arcsim::InputError("face " + std::to_string(f) + ": its rest shape " +
                                     (det < -flattest * longest * longest ? "is inside out (corners clockwise in (u, v))" : "has no area") +
                                     ". Repair the mesh or its rest coordinates");
        g.gu1[l] = b[1] / det;
        g.gv1[l] = -b[0] / det;
        g.gu2[l] = -a[1] / det;
        g.gv2[l] = a[0] / det;
        g.area[l] = i < n_faces_ ? 0.5 * det : 0;
        for (int c = 0; c < 3; ++c) g.node[c][l] = faces[f][c];
    }
}

void MembraneForce::frame(const Group& g, const VectorXd& x, Frame& out) const {
    Lanes d1[3], d2[3];
    for (int l = 0; l < n_lanes; ++l) {
        const double *p0 = x.data() + 3 * g.node[0][l], *p1 = x.data() + 3 * g.node[1][l],
                     *p2 = x.data() + 3 * g.node[2][l];
        for (int c = 0; c < 3; ++c) {
            d1[c][l] = p1[c] - p0[c];
            d2[c][l] = p2[c] - p0[c];
        }
    }
    for (int c = 0; c < 3; ++c) {
        out.u[c] = d1[c] * g.gu1 + d2[c] * g.gu2;
        out.v[c] = d1[c] * g.gv1 + d2[c] * g.gv2;
    }
    const auto& u = out.u;
    const auto& v = out.v;
    out.e.uu = 0.5 * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2] - 1);
    out.e.vv = 0.5 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - 1);
    out.e.uv = 0.5 * (u[0] * v[0] + u[1] * v[1] + u[2] * v[2]);
}

namespace {

/// The part F M Fᵀ of a block, with M = B_iᵀ C B_j of the corners' gradients a and b.
struct Stiffness2 {
    Lanes uu, uv, vu, vv;
};

Stiffness2 material_part(const Lanes C[6], const Lanes& au, const Lanes& av, const Lanes& bu, const Lanes& bv) {
    // C B_j: columns for the u and the v part of the corner's motion
    const Lanes c0u = C[0] * bu + C[2] * bv, c0v = C[1] * bv + C[2] * bu;
    const Lanes c1u = C[1] * bu + C[4] * bv, c1v = C[3] * bv + C[4] * bu;
    const Lanes c2u = C[2] * bu + C[5] * bv, c2v = C[4] * bv + C[5] * bu;
    return {au * c0u + av * c2u, au * c0v + av * c2v, av * c1u + au * c2u, av * c1v + au * c2v};
}

Stiffness2 skew_part(const Lanes w[3], const Lanes& au, const Lanes& av, const Lanes& bu, const Lanes& bv) {
    const Lanes c0u = w[1] * bv, c0v = w[0] * bv + w[1] * bu;
    const Lanes c1u = w[2] * bv - w[0] * bu, c1v = w[2] * bu;
    const Lanes c2u = -w[1] * bu, c2v = -w[2] * bv;
    return {au * c0u + av * c2u, au * c0v + av * c2v, av * c1u + au * c2u, av * c1v + au * c2v};
}

/// Block rows r, columns c at [r + 3 c].
void sandwich(const Lanes u[3], const Lanes v[3], const Stiffness2& M, const Lanes& diagonal, Lanes out[9]) {
    for (int c = 0; c < 3; ++c) {
        const Lanes a = M.uu * u[c] + M.uv * v[c], b = M.vu * u[c] + M.vv * v[c];
        for (int r = 0; r < 3; ++r) out[r + 3 * c] = u[r] * a + v[r] * b;
        out[c + 3 * c] += diagonal;
    }
}

/// Principal stresses below zero taken out.
void drop_compression(StressLanes& s) {
    const Lanes m = 0.5 * (s.uu + s.vv), d = 0.5 * (s.uu - s.vv), R = arcsim::square_root(d * d + s.uv * s.uv);
    const Lanes high = arcsim::larger(m + R, Lanes{}), low = arcsim::larger(m - R, Lanes{});
    const Lanes mean = 0.5 * (high + low), half = 0.5 * (high - low) / arcsim::select(R > 0, R, arcsim::all_lanes(1));
    s.uu = mean + half * d;
    s.vv = mean - half * d;
    s.uv = half * s.uv;
}

}  // namespace

template <bool gradient, bool hessian>
void MembraneForce::assemble(const State& s, Tangent t, VectorXd* g, BlockMatrix* H) const {
    const bool definite = t == Tangent::definite;
    const Want want = !hessian ? Want::stress : definite ? Want::definite_tangent : Want::tangent;
    const bool with_skew = hessian && H->is_general() && !definite && is_unsymmetric();
    Frame fr;
    StressLanes st;
    for (int i = 0; i < static_cast<int>(groups_.size()); ++i) {
        const Group& group = groups_[i];
        frame(group, s.x, fr);
        law_->evaluate(fr.e, want, st);
        const int n = std::min(n_lanes, n_faces_ - n_lanes * i);
        const Lanes A = group.area;
        if constexpr (gradient) {
            Lanes g1[3], g2[3];
            const Lanes s1u = A * (st.uu * group.gu1 + st.uv * group.gv1);
            const Lanes s1v = A * (st.uv * group.gu1 + st.vv * group.gv1);
            const Lanes s2u = A * (st.uu * group.gu2 + st.uv * group.gv2);
            const Lanes s2v = A * (st.uv * group.gu2 + st.vv * group.gv2);
            for (int c = 0; c < 3; ++c) {
                g1[c] = fr.u[c] * s1u + fr.v[c] * s1v;
                g2[c] = fr.u[c] * s2u + fr.v[c] * s2v;
            }
            for (int l = 0; l < n; ++l) {
                double *o0 = g->data() + 3 * group.node[0][l], *o1 = g->data() + 3 * group.node[1][l],
                       *o2 = g->data() + 3 * group.node[2][l];
                for (int c = 0; c < 3; ++c) {
                    const double a = g1[c][l], b = g2[c][l];
                    o0[c] -= a + b;
                    o1[c] += a;
                    o2[c] += b;
                }
            }
        }
        if constexpr (hessian) {
            if (definite) drop_compression(st);
            Lanes C[6];
            for (int k = 0; k < 6; ++k) C[k] = A * st.C[k];
            const auto geometric = [&](const Lanes& au, const Lanes& av, const Lanes& bu, const Lanes& bv) {
                return A * (au * (st.uu * bu + st.uv * bv) + av * (st.uv * bu + st.vv * bv));
            };
            const Lanes &u1 = group.gu1, &v1 = group.gv1, &u2 = group.gu2, &v2 = group.gv2;
            BlockLanes K;
            sandwich(fr.u, fr.v, material_part(C, u1, v1, u1, v1), geometric(u1, v1, u1, v1), K.b11);
            sandwich(fr.u, fr.v, material_part(C, u1, v1, u2, v2), geometric(u1, v1, u2, v2), K.b12);
            sandwich(fr.u, fr.v, material_part(C, u2, v2, u2, v2), geometric(u2, v2, u2, v2), K.b22);
            scatter(complete(K, Half::symmetric), Half::symmetric, group.node, n_lanes * i, n, *pattern_, H->values());
            if (with_skew) {
                Lanes w[3];
                for (int k = 0; k < 3; ++k) w[k] = A * st.skew[k];
                const Lanes zero{};
                sandwich(fr.u, fr.v, skew_part(w, u1, v1, u1, v1), zero, K.b11);
                sandwich(fr.u, fr.v, skew_part(w, u1, v1, u2, v2), zero, K.b12);
                sandwich(fr.u, fr.v, skew_part(w, u2, v2, u2, v2), zero, K.b22);
                scatter(complete(K, Half::antisymmetric), Half::antisymmetric, group.node, n_lanes * i, n, *pattern_,
                        H->skew_values());
            }
        }
    }
}

std::optional<double> MembraneForce::energy(const State& s) const {
    if (!law_->has_potential()) return std::nullopt;
    Frame fr;
    StressLanes st;
    Lanes sum{};
    for (const Group& group : groups_) {
        frame(group, s.x, fr);
        law_->evaluate(fr.e, Want::energy, st);
        sum += group.area * st.psi;
    }
    double E = 0;
    for (int l = 0; l < n_lanes; ++l) E += sum[l];
    return E;
}

void MembraneForce::add_gradient(const State& s, VectorXd& g) const {
    assemble<true, false>(s, Tangent::exact, &g, nullptr);
}
void MembraneForce::add_hessian(const State& s, Tangent t, BlockMatrix& H) const {
    assemble<false, true>(s, t, nullptr, &H);
}
void MembraneForce::add_gradient_and_hessian(const State& s, Tangent t, VectorXd& g, BlockMatrix& H) const {
    assemble<true, true>(s, t, &g, &H);
}

void MembraneForce::add_laplacian(double T0, BlockMatrix& H) const {
    for (int i = 0; i < static_cast<int>(groups_.size()); ++i) {
        const Group& g = groups_[i];
        const Lanes w11 = T0 * g.area * (g.gu1 * g.gu1 + g.gv1 * g.gv1);
        const Lanes w12 = T0 * g.area * (g.gu1 * g.gu2 + g.gv1 * g.gv2);
        const Lanes w22 = T0 * g.area * (g.gu2 * g.gu2 + g.gv2 * g.gv2);
        BlockLanes K{};
        for (int c = 0; c < 3; ++c) {
            K.b11[4 * c] = w11;
            K.b12[4 * c] = w12;
            K.b22[4 * c] = w22;
        }
        scatter(complete(K, Half::symmetric), Half::symmetric, g.node, n_lanes * i,
                std::min(n_lanes, n_faces_ - n_lanes * i), *pattern_, H.values());
    }
}

double MembraneForce::total_rest_area() const {
    double sum = 0;
    for (int f = 0; f < n_faces_; ++f) sum += rest_area(f);
    return sum;
}

arcsim::Matrix32d MembraneForce::deformation(const VectorXd& x, int f) const {
    const Group& g = groups_[f / n_lanes];
    const int l = f % n_lanes;
    const Vector3d x0 = x.segment<3>(3 * g.node[0][l]);
    const Vector3d d1 = x.segment<3>(3 * g.node[1][l]) - x0, d2 = x.segment<3>(3 * g.node[2][l]) - x0;
    arcsim::Matrix32d F;
    F.col(0) = d1 * g.gu1[l] + d2 * g.gu2[l];
    F.col(1) = d1 * g.gv1[l] + d2 * g.gv2[l];
    return F;
}

Vector3d MembraneForce::strain(const VectorXd& x, int f) const {
    const arcsim::Matrix32d F = deformation(x, f);
    return {0.5 * (F.col(0).squaredNorm() - 1), 0.5 * (F.col(1).squaredNorm() - 1), 0.5 * F.col(0).dot(F.col(1))};
}

std::array<double, 2> MembraneForce::stretch_range(const VectorXd& x) const {
    Lanes high = arcsim::all_lanes(-0.5), low = arcsim::all_lanes(1e300);
    Frame fr;
    for (const Group& group : groups_) {
        frame(group, x, fr);
        const Lanes m = 0.5 * (fr.e.uu + fr.e.vv), d = 0.5 * (fr.e.uu - fr.e.vv);
        const Lanes R = arcsim::square_root(d * d + fr.e.uv * fr.e.uv);
        high = arcsim::larger(high, m + R);
        low = arcsim::smaller(low, m - R);
    }
    double e_high = -0.5, e_low = 1e300;
    for (int l = 0; l < n_lanes; ++l) {
        e_high = std::max(e_high, double(high[l]));
        e_low = std::min(e_low, double(low[l]));
    }
    return {std::sqrt(std::max(0.0, 1 + 2 * e_high)), std::sqrt(std::max(0.0, 1 + 2 * e_low))};
}

}  // namespace formwork
