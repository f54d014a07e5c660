#include "arcsim/force/bend_force.hpp"

#include <algorithm>
#include <numeric>

#include "arcsim/base/jet.hpp"
#include "arcsim/force/hinge_element.hpp"

namespace arcsim {
namespace {

/// Coupled corner pairs of a hinge.
constexpr int pair_corner[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

void corners(const Hinge& hinge, const VectorXd& x, double (&p)[4][3]) {
    for (int i = 0; i < 4; ++i)
        for (int c = 0; c < 3; ++c) p[i][c] = x[3 * hinge.node[i] + c];
}

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

struct BendForce::Group {
    Lanes rest_angle{}, beta{};
    int node[4][n_lanes]{};
    int hinge[n_lanes]{};
    int first[10][n_lanes]{}, stride[10][n_lanes]{};   // six pairs, four diagonals
    int row[6][n_lanes]{}, col[6][n_lanes]{};          // corners of the stored block's row and column
    int count = 0;
};

struct BendForce::GroupList : std::vector<Group> {};

BendForce::BendForce(std::vector<Hinge> hinges, std::vector<BendingTable> tables, const VectorXd& x)
    : hinges_(std::move(hinges)), tables_(std::move(tables)), lagged_(hinges_.size()), present_(hinges_.size()),
      stiffness_(hinges_.size()), slope_(hinges_.size()), groups_(std::make_shared<GroupList>()) {
    for (size_t i = 0; i < hinges_.size(); ++i) lagged_[i] = hinges_[i].rest_angle;
    std::vector<int> order(hinges_.size());
    std::iota(order.begin(), order.end(), 0);
    make_groups(order, nullptr);
    refresh(x);
}

void BendForce::list_pairs(std::vector<std::array<int, 2>>& pairs) const {
    for (const Hinge& h : hinges_) pairs.push_back({h.node[2], h.node[3]});
}

void BendForce::bind(const BlockPattern& pattern) {
    std::vector<int> order(hinges_.size()), key(hinges_.size());
    std::iota(order.begin(), order.end(), 0);
    const auto& place = pattern.place_of();
    for (size_t i = 0; i < hinges_.size(); ++i) {
        const auto& n = hinges_[i].node;
        key[i] = std::min({place[n[0]], place[n[1]], place[n[2]], place[n[3]]});
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key[a] < key[b]; });
    make_groups(order, &pattern);
}

void BendForce::make_groups(const std::vector<int>& order, const BlockPattern* pattern) {
    groups_->assign(lane_groups(static_cast<int>(order.size())), Group{});
    for (size_t n = 0; n < order.size(); ++n) {
        const Hinge& hinge = hinges_[order[n]];
        Group& g = (*groups_)[n / n_lanes];
        const int lane = static_cast<int>(n % n_lanes);
        g.count = lane + 1;
        g.hinge[lane] = order[n];
        g.rest_angle[lane] = hinge.rest_angle;
        g.beta[lane] = hinge.damping;
        for (int k = 0; k < 4; ++k) g.node[k][lane] = 3 * hinge.node[k];
        if (!pattern) continue;
        for (int k = 0; k < 6; ++k) {
            int row = pair_corner[k][0], col = pair_corner[k][1];
            const BlockSlot slot = pattern->slot(hinge.node[row], hinge.node[col]);
            if (slot.transposed) std::swap(row, col);
            g.row[k][lane] = 3 * row;
            g.col[k][lane] = 3 * col;
            g.first[k][lane] = slot.first;
            g.stride[k][lane] = slot.stride;
        }
        for (int k = 0; k < 4; ++k) {
            const BlockSlot slot = pattern->diagonal(hinge.node[k]);
            g.first[6 + k][lane] = slot.first;
            g.stride[6 + k][lane] = slot.stride;
        }
    }
    // Lanes without a hinge stand on the last one's corners, so that nothing divides by zero.
    if (!groups_->empty())
        for (Group& g : {std::ref(groups_->back())})
            for (int lane = g.count; lane < n_lanes; ++lane)
                for (int k = 0; k < 4; ++k) g.node[k][lane] = g.node[k][g.count - 1];
}

template <bool with_gradient, bool with_hessian, class Weight>
void BendForce::assemble(const VectorXd& x, double sign, Weight weight, VectorXd* g, BlockMatrix* H) const {
    for (const Group& group : *groups_) {
        Lanes p[4][3];
        for (int lane = 0; lane < n_lanes; ++lane)
            for (int k = 0; k < 4; ++k)
                for (int c = 0; c < 3; ++c) p[k][c][lane] = x[group.node[k][lane] + c];
        const auto fold = hinge::fold(p);
        alignas(64) double gradient[n_lanes][12];
        for (int lane = 0; lane < group.count; ++lane)
            for (int k = 0; k < 4; ++k)
                for (int c = 0; c < 3; ++c) gradient[lane][3 * k + c] = fold.gradient[k][c][lane];
        Lanes stiffness{};
        for (int lane = 0; lane < group.count; ++lane) stiffness[lane] = stiffness_[group.hinge[lane]];
        if constexpr (with_gradient) {
            for (int lane = 0; lane < group.count; ++lane) {
                const double theta = hinge::unwrap(std::atan2(fold.sine[lane], fold.cosine[lane]),
                                                   lagged_[group.hinge[lane]]);
                present_[group.hinge[lane]] = theta;
                const double moment = sign * stiffness[lane] * (theta - group.rest_angle[lane]);
                for (int k = 0; k < 4; ++k)
                    for (int c = 0; c < 3; ++c)
                        (*g)[group.node[k][lane] + c] += moment * gradient[lane][3 * k + c];
            }
        }
        if constexpr (with_hessian) {
            const Lanes w = stiffness * weight(group.beta);
            double* values = H->values();
            for (int lane = 0; lane < group.count; ++lane) {
                const double* d = gradient[lane];
                const auto add = [&](int place, const double* row, const double* col) {
                    double* to = values + group.first[place][lane];
                    const int stride = group.stride[place][lane];
                    for (int c = 0; c < 3; ++c) {
                        const double factor = w[lane] * col[c];
                        for (int r = 0; r < 3; ++r) to[c * stride + r] += factor * row[r];
                    }
                };
                for (int k = 0; k < 6; ++k) add(k, d + group.row[k][lane], d + group.col[k][lane]);
                for (int k = 0; k < 4; ++k) add(6 + k, d + 3 * k, d + 3 * k);
            }
        }
    }
}

void BendForce::add_gradient(const State& s, VectorXd& g) const {
    assemble<true, false>(s.x, 1, Plain{}, &g, nullptr);
}

void BendForce::add_hessian(const State& s, Tangent t, BlockMatrix& H) const {
    if (t == Tangent::exact) return add_exact_hessian(s.x, H);
    assemble<false, true>(s.x, 1, Plain{}, nullptr, &H);
}

void BendForce::add_gradient_and_hessian(const State& s, Tangent t, VectorXd& g, BlockMatrix& H) const {
    if (t == Tangent::definite) return assemble<true, true>(s.x, 1, Plain{}, &g, &H);
    add_gradient(s, g);
    add_exact_hessian(s.x, H);
}

void BendForce::add_step(const State& s, double h, VectorXd& f, BlockMatrix& A) const {
    assemble<true, true>(s.x, -1, Step{h}, &f, &A);
}

bool BendForce::is_damped() const {
    return std::any_of(hinges_.begin(), hinges_.end(), [](const Hinge& h) { return h.damping != 0; });
}

void BendForce::add_damping(const State& s, BlockMatrix& H) const {
    if (is_damped())
        assemble<false, true>(s.x, 1, Damping{}, nullptr, &H);
}

double BendForce::angle(const VectorXd& x, int i) const {
    double p[4][3];
    corners(hinges_[i], x, p);
    const auto fold = hinge::fold(p);
    return hinge::unwrap(std::atan2(fold.sine, fold.cosine), lagged_[i]);
}

double BendForce::frozen_energy(const State& s) const {
    double energy = 0;
    for (size_t i = 0; i < hinges_.size(); ++i) {
        const double bend = angle(s.x, static_cast<int>(i)) - hinges_[i].rest_angle;
        energy += 0.5 * stiffness_[i] * bend * bend;
    }
    return energy;
}

void BendForce::add_exact_hessian(const VectorXd& x, BlockMatrix& H) const {
    using Number = Jet<12>;
    for (size_t i = 0; i < hinges_.size(); ++i) {
        const Hinge& hinge = hinges_[i];
        Number p[4][3];
        for (int k = 0; k < 4; ++k)
            for (int c = 0; c < 3; ++c) p[k][c] = Number::variable(x[3 * hinge.node[k] + c], 3 * k + c);
        const auto fold = hinge::fold(p);
        const double theta = hinge::unwrap(std::atan2(fold.sine.value, fold.cosine.value), lagged_[i]);
        const double bend = theta - hinge.rest_angle;
        const double along = stiffness_[i] + (follows_ ? slope_[i] * bend : 0);   // of the product of gradients
        const auto block = [&](int a, int b) {
            Matrix3d B;
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c)
                    B(r, c) = along * fold.gradient[a][r].value * fold.gradient[b][c].value +
                              stiffness_[i] * bend * fold.gradient[a][r].d[3 * b + c];
            return B;
        };
        for (int k = 0; k < 4; ++k) H.add_diagonal(hinge.node[k], block(k, k));
        for (const auto& [a, b] : pair_corner)
            H.add(H.pattern().slot(hinge.node[a], hinge.node[b]), block(a, b), block(b, a));
    }
}

void BendForce::refresh(const VectorXd& x) {
    for (const Group& group : *groups_) {
        Lanes p[4][3];
        for (int lane = 0; lane < n_lanes; ++lane)
            for (int k = 0; k < 4; ++k)
                for (int c = 0; c < 3; ++c) p[k][c][lane] = x[group.node[k][lane] + c];
        const auto fold = hinge::fold(p);
        for (int lane = 0; lane < group.count; ++lane) {
            double& lagged = lagged_[group.hinge[lane]];
            lagged = hinge::unwrap(std::atan2(fold.sine[lane], fold.cosine[lane]), lagged);
        }
    }
    look_up_stiffness();
}

void BendForce::keep_step_angles() {
    lagged_ = present_;
    look_up_stiffness();
}

void BendForce::set_lagged_angles(std::vector<double> angles) {
    lagged_ = std::move(angles);
    look_up_stiffness();
}

void BendForce::look_up_stiffness() {
    for (size_t i = 0; i < hinges_.size(); ++i) {
        const Hinge& h = hinges_[i];
        const double curvature = lagged_[i] * h.length / h.area;
        auto sample = tables_[h.material[0]].sample(h.direction[0], curvature);
        const auto other = tables_[h.material[1]].sample(h.direction[1], curvature);
        if (other.k < sample.k) sample = other;
        const double factor = h.length * h.length / (4 * h.area * h.softening);
        stiffness_[i] = factor * sample.k;
        slope_[i] = factor * sample.slope * h.length / h.area;
    }
}

void BendForce::set_rest_angles_from(const VectorXd& x) {
    for (size_t i = 0; i < hinges_.size(); ++i) hinges_[i].rest_angle = angle(x, static_cast<int>(i));
    for (Group& g : *groups_)
        for (int lane = 0; lane < g.count; ++lane) g.rest_angle[lane] = hinges_[g.hinge[lane]].rest_angle;
}

}  // namespace arcsim
