#include "formwork/panels/seam_match.hpp"

#include <Eigen/CholmodSupport>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>

#include "arcsim/base/error.hpp"
#include "formwork/flatten/isometry_energy.hpp"

namespace formwork {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr int max_iterations = 60;
constexpr double length_tolerance = 5e-6;   // of a stretch: far below what scissors resolve
constexpr double energy_tolerance = 1e-4;   // of E - 4: the equality costs little, the last digits nothing
constexpr double relative_shift = 1e-9;     // keeps H definite along the rigid motions

/// One equality: the length of a seam's chain, each edge with a weight, the same on both sides.
///
/// The multiplier of a length is a tension along the seam; where it jumps or where the chain has kinks it pulls
/// sideways, and one side grows spikes to gain length. So most equalities weigh the edges by overlapping hat
/// functions, whose tension is continuous along the seam; those between notches, which is what is sewn, then
/// settle the little that the hats leave over.
struct Equality {
    struct Edge {
        int first;       // of its two vertices along the chain
        double weight;
    };
    int seam = 0;
    double rest_length = 0;   // weighted, on the surface, m
    std::vector<Edge> edges;
};

constexpr double hats_per_spacing = 2;

std::vector<Equality> equalities(const PanelSet& set, const Segmentation& s) {
    std::vector<Equality> all;
    for (std::size_t i = 0; i < set.seams.size(); ++i) {
        if (set.seams[i].is_rim()) continue;
        const std::vector<int>& nodes = s.seams[i].nodes;
        const int n = static_cast<int>(nodes.size()) - 1;   // edges
        std::vector<double> at{0};
        for (int k = 0; k < n; ++k) at.push_back(at.back() + (s.mesh.x[nodes[k + 1]] - s.mesh.x[nodes[k]]).norm());
        const double length = at.back();
        const auto add = [&](const auto& weight) {
            Equality equality;
            equality.seam = static_cast<int>(i);
            for (int k = 0; k < n; ++k) {
                const double w = weight(at[k], at[k + 1]);
                if (w <= 0) continue;
                equality.edges.push_back({k, w});
                equality.rest_length += w * (at[k + 1] - at[k]);
            }
            if (!equality.edges.empty()) all.push_back(std::move(equality));
        };
        const int hats = std::max(1, static_cast<int>(std::round(hats_per_spacing * length / (set.params.notch_spacing_mm / 1000))));
        for (int h = 0; h <= hats; ++h)
            add([&](double from, double to) { return std::max(0.0, 1 - std::abs((from + to) / 2 / length * hats - h)); });
        std::vector<double> cuts{0};
        for (double f : set.seams[i].notch_rest) cuts.push_back(f * length);
        cuts.push_back(length);
        for (std::size_t c = 0; c + 1 < cuts.size(); ++c)
            add([&](double from, double to) { return (std::min(to, cuts[c + 1]) - std::max(from, cuts[c])) / (to - from); });
    }
    return all;
}

/// One panel of the joint problem.
struct Block {
    std::unique_ptr<IsometryEnergy> energy;
    double weight = 1;   // share of the whole area
    VectorXd u, gradient;
    Sparse hessian;
    Eigen::CholmodDecomposition<Sparse, Eigen::Lower> solver;
    std::vector<int> rows;       // constraints that touch this panel
    Eigen::MatrixXd b, h_inv_b;  // (2n x rows): Bᵀ and H⁻¹ Bᵀ
    VectorXd h_inv_g, step;
};

class JointProblem {
public:
    JointProblem(PanelSet& set, const std::vector<std::vector<Matrix2d>>& shapes, const std::vector<Equality>& all)
        : set_(set), equalities_(all), blocks_(set.panels.size()) {
        double total = 0;
        for (std::size_t p = 0; p < blocks_.size(); ++p) {
            const FlatPanel& panel = set.panels[p];
            Block& block = blocks_[p];
            block.energy = std::make_unique<IsometryEnergy>(panel.faces, shapes[p], static_cast<int>(panel.u.size()), set.params.peak_weight);
            block.weight = 0;
            for (const Matrix2d& d : shapes[p]) block.weight += d.determinant() / 2;
            total += block.weight;
            block.u.resize(2 * panel.u.size());
            for (std::size_t i = 0; i < panel.u.size(); ++i) block.u.segment<2>(2 * i) = panel.u[i];
        }
        for (Block& block : blocks_) block.weight /= total;
        for (std::size_t j = 0; j < all.size(); ++j)
            for (const SeamSide& side : set.seams[all[j].seam].side) {
                std::vector<int>& rows = blocks_[side.panel].rows;
                if (rows.empty() || rows.back() != static_cast<int>(j)) rows.push_back(static_cast<int>(j));
            }
    }

    /// @returns the largest relative difference after the solve
    double solve() {
        VectorXd c = differences(0);
        double energy = total_energy(0), penalty = 0;
        for (int iteration = 0; iteration < max_iterations; ++iteration) {
            const VectorXd lambda = step_and_multipliers(c);
            penalty = std::max(penalty, 2 * lambda.cwiseAbs().maxCoeff());
            double predicted = 0;
            for (Block& block : blocks_) predicted += block.weight * block.gradient.dot(block.step);
            predicted -= penalty * c.lpNorm<1>();
            double t = 1;
            for (const Block& block : blocks_) t = std::min(t, block.energy->largest_step(block.u, block.step));
            const double merit = energy + penalty * c.lpNorm<1>();
            constexpr double armijo = 1e-4, smallest_step = 1e-10;
            double trial = merit_at(t, penalty);
            while (!(trial <= merit + armijo * t * predicted) && t > smallest_step) trial = merit_at(t /= 2, penalty);
            if (t <= smallest_step) break;   // rounding: nothing left to gain
            for (Block& block : blocks_) block.u += t * block.step;
            const double before = energy;
            energy = total_energy(0);
            c = differences(0);
            if (worst(c) < length_tolerance && std::abs(before - energy) <= energy_tolerance * energy + 1e-14) break;
        }
        for (std::size_t p = 0; p < blocks_.size(); ++p)
            for (std::size_t i = 0; i < set_.panels[p].u.size(); ++i) set_.panels[p].u[i] = blocks_[p].u.segment<2>(2 * i);
        return worst(c);
    }

private:
    double total_energy(double t) const {
        double sum = 0;
        for (const Block& block : blocks_)
            sum += block.weight * (t == 0 ? block.energy->value(block.u) : block.energy->value(block.u + t * block.step));
        return sum;
    }

    Vector2d point(int panel, int vertex, double t) const {
        const Block& block = blocks_[panel];
        Vector2d p = block.u.segment<2>(2 * vertex);
        if (t != 0) p += t * block.step.segment<2>(2 * vertex);
        return p;
    }

    /// c_j: side 0 longer than side 1 by so much, m.
    VectorXd differences(double t) const {
        VectorXd c(equalities_.size());
        for (std::size_t j = 0; j < equalities_.size(); ++j) {
            double sum = 0;
            for (int i : {0, 1}) {
                const SeamSide& side = set_.seams[equalities_[j].seam].side[i];
                for (const auto& [k, weight] : equalities_[j].edges)
                    sum += (i == 0 ? weight : -weight) * (point(side.panel, side.vertex[k + 1], t) - point(side.panel, side.vertex[k], t)).norm();
            }
            c[j] = sum;
        }
        return c;
    }

    double merit_at(double t, double penalty) const { return total_energy(t) + penalty * differences(t).lpNorm<1>(); }

    double worst(const VectorXd& c) const {
        double w = 0;
        for (std::size_t j = 0; j < equalities_.size(); ++j) w = std::max(w, std::abs(c[j]) / equalities_[j].rest_length);
        return w;
    }

    /// Fills every block's step; returns the multipliers.
    VectorXd step_and_multipliers(const VectorXd& c) {
        const int m = static_cast<int>(equalities_.size());
        Eigen::MatrixXd s = Eigen::MatrixXd::Zero(m, m);
        VectorXd right = c;
        for (std::size_t p = 0; p < blocks_.size(); ++p) {
            Block& block = blocks_[p];
            const bool first = block.hessian.nonZeros() == 0;
            block.energy->assemble(block.u, relative_shift * block.energy->diagonal_scale(), block.gradient, block.hessian);
            if (first) block.solver.analyzePattern(block.hessian);
            block.solver.factorize(block.hessian);
            if (block.solver.info() != Eigen::Success)
                throw arcsim::NumericalError("panels: the Hessian of panel " + std::to_string(p + 1) + " cannot be factorised.");
            fill_rows(static_cast<int>(p));
            block.h_inv_g = block.solver.solve(block.gradient);
            block.h_inv_b = block.solver.solve(block.b) / block.weight;
            const Eigen::MatrixXd local = block.b.transpose() * block.h_inv_b;
            const VectorXd bg = block.b.transpose() * block.h_inv_g;
            for (std::size_t i = 0; i < block.rows.size(); ++i) {
                right[block.rows[i]] -= bg[i];
                for (std::size_t k = 0; k < block.rows.size(); ++k) s(block.rows[i], block.rows[k]) += local(i, k);
            }
        }
        s.diagonal().array() += 1e-12 * s.trace() / m;   // two identical rows, should a layout have them
        const VectorXd lambda = s.ldlt().solve(right);
        for (Block& block : blocks_) {
            VectorXd mine(block.rows.size());
            for (std::size_t i = 0; i < block.rows.size(); ++i) mine[i] = lambda[block.rows[i]];
            block.step = -block.h_inv_g - block.h_inv_b * mine;
        }
        return lambda;
    }

    void fill_rows(int p) {
        Block& block = blocks_[p];
        block.b = Eigen::MatrixXd::Zero(block.u.size(), block.rows.size());
        for (std::size_t r = 0; r < block.rows.size(); ++r) {
            const Equality& equality = equalities_[block.rows[r]];
            for (int i : {0, 1}) {
                const SeamSide& side = set_.seams[equality.seam].side[i];
                if (side.panel != p) continue;
                for (const auto& [k, weight] : equality.edges) {
                    const int a = side.vertex[k], b = side.vertex[k + 1];
                    const Vector2d d = (i == 0 ? weight : -weight) * (point(p, b, 0) - point(p, a, 0)).normalized();
                    block.b.col(r).segment<2>(2 * b) += d;
                    block.b.col(r).segment<2>(2 * a) -= d;
                }
            }
        }
    }

    PanelSet& set_;
    const std::vector<Equality>& equalities_;
    std::vector<Block> blocks_;
};

}  // namespace

double match_seams(PanelSet& set, const Segmentation& s, const std::vector<std::vector<Matrix2d>>& shapes) {
    const std::vector<Equality> all = equalities(set, s);
    if (all.empty()) return 0;
    return JointProblem(set, shapes, all).solve();
}

}  // namespace formwork
