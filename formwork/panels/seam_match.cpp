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
constexpr double length_tolerance = 1e-7;   // of a stretch: far below what scissors resolve
constexpr double energy_tolerance = 1e-5;   // of E - 4: the equality costs little, the last digits nothing
constexpr double relative_shift = 1e-9;     // keeps H definite along the rigid motions

/// One stretch of a seam between two notches; edges at its ends count in part.
struct Stretch {
    int seam = 0;
    double rest_length = 0;
    std::vector<std::pair<int, double>> edge;   // index along the chain, share of the edge
};

std::vector<Stretch> stretches(const PanelSet& set, const std::vector<std::vector<double>>& edge_lengths) {
    std::vector<Stretch> all;
    for (std::size_t i = 0; i < set.seams.size(); ++i) {
        const PanelSeam& seam = set.seams[i];
        if (seam.is_rim()) continue;
        std::vector<double> cuts{0};
        for (double f : seam.notch_rest) cuts.push_back(f * seam.rest_length);
        cuts.push_back(seam.rest_length);
        for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
            Stretch stretch;
            stretch.seam = static_cast<int>(i);
            stretch.rest_length = cuts[c + 1] - cuts[c];
            double from = 0;
            for (std::size_t k = 0; k < edge_lengths[i].size(); ++k) {
                const double to = from + edge_lengths[i][k];
                const double share = (std::min(to, cuts[c + 1]) - std::max(from, cuts[c])) / (to - from);
                if (share > 0) stretch.edge.emplace_back(static_cast<int>(k), share);
                from = to;
            }
            all.push_back(std::move(stretch));
        }
    }
    return all;
}

/// Nothing but lengths along the chain on the surface, to share out edges that a notch divides.
std::vector<std::vector<double>> rest_edge_lengths(const PanelSet& set, const Segmentation& s) {
    std::vector<std::vector<double>> lengths(set.seams.size());
    for (std::size_t i = 0; i < set.seams.size(); ++i) {
        const std::vector<int>& nodes = s.seams[i].nodes;
        for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
            lengths[i].push_back((s.mesh.x[nodes[k + 1]] - s.mesh.x[nodes[k]]).norm());
    }
    return lengths;
}

double stretch_length(const Stretch& stretch, const SeamSide& side, const std::vector<Vector2d>& u) {
    double sum = 0;
    for (const auto& [k, share] : stretch.edge) sum += share * (u[side.vertex[k + 1]] - u[side.vertex[k]]).norm();
    return sum;
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
    JointProblem(PanelSet& set, const std::vector<std::vector<Matrix2d>>& shapes, const std::vector<Stretch>& all)
        : set_(set), stretches_(all), blocks_(set.panels.size()) {
        double total = 0;
        for (std::size_t p = 0; p < blocks_.size(); ++p) {
            const FlatPanel& panel = set.panels[p];
            Block& block = blocks_[p];
            block.energy = std::make_unique<IsometryEnergy>(panel.faces, shapes[p], static_cast<int>(panel.u.size()));
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
        VectorXd c(stretches_.size());
        for (std::size_t j = 0; j < stretches_.size(); ++j) {
            double sum = 0;
            for (int i : {0, 1}) {
                const SeamSide& side = set_.seams[stretches_[j].seam].side[i];
                for (const auto& [k, share] : stretches_[j].edge)
                    sum += (i == 0 ? share : -share) * (point(side.panel, side.vertex[k + 1], t) - point(side.panel, side.vertex[k], t)).norm();
            }
            c[j] = sum;
        }
        return c;
    }

    double merit_at(double t, double penalty) const { return total_energy(t) + penalty * differences(t).lpNorm<1>(); }

    double worst(const VectorXd& c) const {
        double w = 0;
        for (std::size_t j = 0; j < stretches_.size(); ++j) w = std::max(w, std::abs(c[j]) / stretches_[j].rest_length);
        return w;
    }

    /// Fills every block's step; returns the multipliers.
    VectorXd step_and_multipliers(const VectorXd& c) {
        const int m = static_cast<int>(stretches_.size());
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
            const Stretch& stretch = stretches_[block.rows[r]];
            for (int i : {0, 1}) {
                const SeamSide& side = set_.seams[stretch.seam].side[i];
                if (side.panel != p) continue;
                for (const auto& [k, share] : stretch.edge) {
                    const int a = side.vertex[k], b = side.vertex[k + 1];
                    const Vector2d d = (i == 0 ? share : -share) * (point(p, b, 0) - point(p, a, 0)).normalized();
                    block.b.col(r).segment<2>(2 * b) += d;
                    block.b.col(r).segment<2>(2 * a) -= d;
                }
            }
        }
    }

    PanelSet& set_;
    const std::vector<Stretch>& stretches_;
    std::vector<Block> blocks_;
};

}  // namespace

double match_seams(PanelSet& set, const Segmentation& s, const std::vector<std::vector<Matrix2d>>& shapes) {
    const std::vector<Stretch> all = stretches(set, rest_edge_lengths(set, s));
    if (all.empty()) return 0;
    return JointProblem(set, shapes, all).solve();
}

void measure_seams(PanelSet& set, const Segmentation& s) {
    for (PanelSeam& seam : set.seams) {
        seam.mismatch = seam.local_mismatch = 0;
        seam.notch.clear();
        for (SeamSide& side : seam.side) {
            side.length = 0;
            for (std::size_t k = 0; k + 1 < side.vertex.size(); ++k)
                side.length += (set.panels[side.panel].u[side.vertex[k + 1]] - set.panels[side.panel].u[side.vertex[k]]).norm();
        }
        if (!seam.is_rim())
            seam.mismatch = std::abs(seam.side[0].length - seam.side[1].length) / std::max(seam.side[0].length, seam.side[1].length);
    }
    std::vector<double> reached(set.seams.size(), 0);   // flat length of side 0 up to the end of the stretch
    for (const Stretch& stretch : stretches(set, rest_edge_lengths(set, s))) {
        PanelSeam& seam = set.seams[stretch.seam];
        const double a = stretch_length(stretch, seam.side[0], set.panels[seam.side[0].panel].u);
        const double b = stretch_length(stretch, seam.side[1], set.panels[seam.side[1].panel].u);
        seam.local_mismatch = std::max(seam.local_mismatch, std::abs(a - b) / std::max(a, b));
        reached[stretch.seam] += a;
        if (seam.notch.size() < seam.notch_rest.size()) seam.notch.push_back(reached[stretch.seam] / seam.side[0].length);
    }
}

}  // namespace formwork
