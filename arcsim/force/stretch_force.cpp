#include "arcsim/force/stretch_force.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace arcsim {
namespace {

/// The three coupled corner pairs of a face, in the order of BlockPattern::face_slots.
constexpr int pair_corner[3][2] = {{0, 1}, {1, 2}, {2, 0}};

}  // namespace

stretch::Strain<double> strain_of(const StretchFace& f, const VectorXd& x) {
    double e1[3], e2[3];
    for (int c = 0; c < 3; ++c) {
        const double x0 = x[3 * f.node[0] + c];
        e1[c] = x[3 * f.node[1] + c] - x0;
        e2[c] = x[3 * f.node[2] + c] - x0;
    }
    return stretch::strain(stretch::shape_of(f.D_inverse), e1, e2);
}

struct StretchForce::Group {
    stretch::Shape<Lanes> shape{};
    Lanes area{}, beta{};
    // Of the stored block of each corner pair: shape derivatives of its row's and its column's corner.
    Lanes row_a[3]{}, row_b[3]{}, col_a[3]{}, col_b[3]{};
    int node[3][n_lanes]{};                               // first of three degrees of freedom
    int first[6][n_lanes]{}, stride[6][n_lanes]{};        // three pairs, three diagonals
    const StiffnessTable* table[n_lanes]{};
    int count = 0;
};

struct StretchForce::GroupList : std::vector<Group> {};

StretchForce::StretchForce(std::vector<StretchFace> faces,
                           std::vector<std::shared_ptr<const StiffnessTable>> tables)
    : faces_(std::move(faces)), tables_(std::move(tables)), groups_(std::make_shared<GroupList>()) {
    std::vector<int> order(faces_.size());
    std::iota(order.begin(), order.end(), 0);
    make_groups(order, nullptr);
}

void StretchForce::bind(const BlockPattern& pattern) {
    // Faces whose nodes stand together in the fill order write to neighbouring memory.
    std::vector<int> order(faces_.size()), key(faces_.size());
    std::iota(order.begin(), order.end(), 0);
    for (size_t f = 0; f < faces_.size(); ++f) {
        const Triangle& t = faces_[f].node;
        const auto& place = pattern.place_of();
        key[f] = std::min({place[t[0]], place[t[1]], place[t[2]]});
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key[a] < key[b]; });
    make_groups(order, &pattern);
}

void StretchForce::make_groups(const std::vector<int>& order, const BlockPattern* pattern) {
    groups_->assign(lane_groups(static_cast<int>(order.size())), Group{});
    for (size_t n = 0; n < order.size(); ++n) {
        const StretchFace& f = faces_[order[n]];
        Group& g = (*groups_)[n / n_lanes];
        const int lane = static_cast<int>(n % n_lanes);
        g.count = lane + 1;
        const auto s = stretch::shape_of(f.D_inverse);
        g.shape.a1[lane] = s.a1;
        g.shape.a2[lane] = s.a2;
        g.shape.b1[lane] = s.b1;
        g.shape.b2[lane] = s.b2;
        g.area[lane] = f.area / f.softening;
        g.beta[lane] = f.damping;
        g.table[lane] = tables_.at(f.material).get();
        const double a[3] = {-s.a1 - s.a2, s.a1, s.a2}, b[3] = {-s.b1 - s.b2, s.b1, s.b2};
        for (int k = 0; k < 3; ++k) {
            g.node[k][lane] = 3 * f.node[k];
            if (!pattern) continue;
            int row = pair_corner[k][0], col = pair_corner[k][1];
            const BlockSlot slot = pattern->slot(f.node[row], f.node[col]);
            if (slot.transposed) std::swap(row, col);
            g.row_a[k][lane] = a[row];
            g.row_b[k][lane] = b[row];
            g.col_a[k][lane] = a[col];
            g.col_b[k][lane] = b[col];
            const BlockSlot diagonal = pattern->diagonal(f.node[k]);
            g.first[k][lane] = slot.first;
            g.stride[k][lane] = slot.stride;
            g.first[3 + k][lane] = diagonal.first;
            g.stride[3 + k][lane] = diagonal.stride;
        }
    }
}

template <bool with_gradient, bool with_hessian, class Weight>
void StretchForce::assemble(const VectorXd& x, double sign, Weight weight, VectorXd* g, BlockMatrix* H) const {
    for (const Group& group : *groups_) {
        Lanes e1[3], e2[3];
        for (int lane = 0; lane < n_lanes; ++lane) {
            const double *x0 = &x[group.node[0][lane]], *x1 = &x[group.node[1][lane]], *x2 = &x[group.node[2][lane]];
            for (int c = 0; c < 3; ++c) {
                e1[c][lane] = x1[c] - x0[c];
                e2[c][lane] = x2[c] - x0[c];
            }
        }
        const auto G = stretch::strain(group.shape, e1, e2);
        Lanes k[4] = {};
        for (int lane = 0; lane < group.count; ++lane) {
            const Stiffness4 value = group.table[lane]->k({G.uu[lane], G.vv[lane], G.uv[lane]});
            for (int entry = 0; entry < 4; ++entry) k[entry][lane] = value[entry];
        }
        if constexpr (with_gradient) {
            Lanes g1[3], g2[3];
            stretch::gradient(group.shape, G, stretch::stress(G, k), sign * group.area, g1, g2);
            double* out = g->data();
            for (int lane = 0; lane < group.count; ++lane)
                for (int c = 0; c < 3; ++c) {
                    out[group.node[0][lane] + c] -= g1[c][lane] + g2[c][lane];
                    out[group.node[1][lane] + c] += g1[c][lane];
                    out[group.node[2][lane] + c] += g2[c][lane];
                }
        }
        if constexpr (with_hessian) {
            const auto coefficients = stretch::coefficients(G, k, group.area * weight(group.beta));
            const Lanes a0 = -group.shape.a1 - group.shape.a2, b0 = -group.shape.b1 - group.shape.b2;
            const Lanes a[3] = {a0, group.shape.a1, group.shape.a2}, b[3] = {b0, group.shape.b1, group.shape.b2};
            double* values = H->values();
            Lanes B[9];
            const auto scatter = [&](int place) {
                for (int lane = 0; lane < group.count; ++lane) {
                    const int stride = group.stride[place][lane];
                    double* to = values + group.first[place][lane];
                    for (int c = 0; c < 3; ++c)
                        for (int r = 0; r < 3; ++r) to[c * stride + r] += B[3 * c + r][lane];
                }
            };
            for (int pair = 0; pair < 3; ++pair) {
                stretch::block(G, coefficients, group.row_a[pair], group.row_b[pair], group.col_a[pair],
                               group.col_b[pair], B);
                scatter(pair);
            }
            for (int corner = 0; corner < 3; ++corner) {
                stretch::block(G, coefficients, a[corner], b[corner], a[corner], b[corner], B);
                scatter(3 + corner);
            }
        }
    }
}

namespace {
/// The element's own weight in the matrix, from its damping.
struct Plain {
    Lanes operator()(const Lanes&) const { return all_lanes(1); }
};
struct Damping {
    Lanes operator()(const Lanes& beta) const { return beta; }
};
struct Step {
    double h;
    Lanes operator()(const Lanes& beta) const { return h * (h + beta); }
};
}  // namespace

void StretchForce::add_gradient(const State& s, VectorXd& g) const {
    assemble<true, false>(s.x, 1, Plain{}, &g, nullptr);
}

void StretchForce::add_hessian(const State& s, Tangent t, BlockMatrix& H) const {
    if (t == Tangent::exact) return add_exact_hessian(s, H);
    assemble<false, true>(s.x, 1, Plain{}, nullptr, &H);
}

void StretchForce::add_gradient_and_hessian(const State& s, Tangent t, VectorXd& g, BlockMatrix& H) const {
    if (t == Tangent::definite) return assemble<true, true>(s.x, 1, Plain{}, &g, &H);
    add_gradient(s, g);
    add_exact_hessian(s, H);
}

void StretchForce::add_step(const State& s, double h, VectorXd& f, BlockMatrix& A) const {
    assemble<true, true>(s.x, -1, Step{h}, &f, &A);
}

bool StretchForce::is_damped() const {
    return std::any_of(faces_.begin(), faces_.end(), [](const StretchFace& f) { return f.damping != 0; });
}

void StretchForce::add_damping(const State& s, BlockMatrix& H) const {
    if (is_damped())
        assemble<false, true>(s.x, 1, Damping{}, nullptr, &H);
}

void StretchForce::add_exact_hessian(const State& s, BlockMatrix& H) const {
    const BlockPattern& pattern = H.pattern();
    for (const StretchFace& f : faces_) {
        const auto G = strain_of(f, s.x);
        const Vector3d strain_vector(G.uu, G.vv, G.uv);
        const StiffnessSample sample = tables_[f.material]->sample(strain_vector);
        const double k[4] = {sample.k[0], sample.k[1], sample.k[2], sample.k[3]};
        const Matrix9d B = stretch::exact_hessian(stretch::shape_of(f.D_inverse), G, stretch::stress(G, k),
                                                  stretch::stress_derivative(strain_vector, sample),
                                                  f.area / f.softening);
        for (int i = 0; i < 3; ++i) {
            H.add_diagonal(f.node[i], B.block<3, 3>(3 * i, 3 * i));
            const int j = (i + 1) % 3;
            H.add(pattern.slot(f.node[i], f.node[j]), B.block<3, 3>(3 * i, 3 * j), B.block<3, 3>(3 * j, 3 * i));
        }
    }
}

double StretchForce::frozen_energy(const State& s) const {
    double energy = 0;
    for (const StretchFace& f : faces_) {
        const Vector3d G = [&] {
            const auto g = strain_of(f, s.x);
            return Vector3d(g.uu, g.vv, g.uv);
        }();
        const Stiffness4 k = tables_[f.material]->k(G);
        energy += f.area / f.softening *
                  (0.5 * k[0] * G[0] * G[0] + 0.5 * k[2] * G[1] * G[1] + k[1] * G[0] * G[1] + k[3] * G[2] * G[2]);
    }
    return energy;
}

Vector3d StretchForce::strain(const VectorXd& x, int f) const {
    const auto g = strain_of(faces_[f], x);
    return {g.uu, g.vv, g.uv};
}

double StretchForce::rest_stiffness() const {
    double k = 0;
    for (const auto& table : tables_) {
        const Stiffness4 rest = table->k(Vector3d::Zero());
        k = std::max(k, *std::max_element(rest.begin(), rest.end()));
    }
    return k;
}

std::pair<int, double> StretchForce::largest_stretch(const VectorXd& x) const {
    int worst = -1;
    double largest = -1;
    for (size_t f = 0; f < faces_.size(); ++f) {
        const Vector3d G = strain(x, static_cast<int>(f));
        const double l1 = 1 + G[0] + G[1] + std::hypot(G[0] - G[1], 2 * G[2]);
        if (!std::isfinite(l1)) return {static_cast<int>(f), l1};
        if (l1 > largest) largest = l1, worst = static_cast<int>(f);
    }
    return {worst, std::sqrt(std::max(largest, 0.0))};
}

}  // namespace arcsim
