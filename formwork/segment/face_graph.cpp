#include "formwork/segment/face_graph.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

#include "arcsim/base/error.hpp"

namespace formwork {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The Laplacian's lower triangle, and its product with a block of vectors.
struct Laplacian {
    LowerPattern pattern;
    std::vector<double> values;
    std::vector<double> scale;   // D^-1/2 when normalised, else 1

    Laplacian(const WeightedGraph& g, bool normalised) : scale(g.n, 1.0) {
        std::vector<double> degree(g.n, 0.0);
        for (const auto& link : g.links) {
            degree[link.a] += link.weight;
            degree[link.b] += link.weight;
        }
        if (normalised)
            for (int i = 0; i < g.n; ++i) scale[i] = degree[i] > 0 ? 1 / std::sqrt(degree[i]) : 0;
        std::vector<WeightedGraph::Link> links = g.links;
        std::sort(links.begin(), links.end(), [](const auto& x, const auto& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });
        pattern.n = g.n;
        auto next = links.begin();
        for (int i = 0; i < g.n; ++i) {
            pattern.column.push_back(static_cast<int>(pattern.row.size()));
            pattern.row.push_back(i);
            values.push_back(degree[i] * scale[i] * scale[i]);
            for (; next != links.end() && next->a == i; ++next) {
                const double entry = -next->weight * scale[i] * scale[next->b];
                if (pattern.row.back() == next->b) values.back() += entry;   // two faces that share two edges
                else {
                    pattern.row.push_back(next->b);
                    values.push_back(entry);
                }
            }
        }
        pattern.column.push_back(static_cast<int>(pattern.row.size()));
    }

    MatrixXd times(const MatrixXd& x) const {
        MatrixXd y = MatrixXd::Zero(x.rows(), x.cols());
        for (int j = 0; j < pattern.n; ++j)
            for (int k = pattern.column[j]; k < pattern.column[j + 1]; ++k) {
                const int i = pattern.row[k];
                y.row(i) += values[k] * x.row(j);
                if (i != j) y.row(j) += values[k] * x.row(i);
            }
        return y;
    }
};

/// The same numbers on every machine: not random, but without the symmetries of the mesh.
MatrixXd scattered_block(int n, int columns) {
    MatrixXd x(n, columns);
    std::uint64_t state = 0x9e3779b97f4a7c15ull;
    for (int c = 0; c < columns; ++c)
        for (int i = 0; i < n; ++i) {
            state ^= state << 13, state ^= state >> 7, state ^= state << 17;
            x(i, c) = static_cast<double>(state >> 11) / 9007199254740992.0 - 0.5;
        }
    return x;
}

}  // namespace

LowModes low_modes(const WeightedGraph& graph, int k, bool normalised) {
    constexpr int max_steps = 200;
    constexpr double enough = 1e-7;   // residual relative to the largest eigenvalue looked for
    const Laplacian laplacian(graph, normalised);
    const int n = graph.n, block = std::min(n, 2 * k + 6);
    double largest = 0;
    for (int i = 0; i < n; ++i) largest = std::max(largest, laplacian.values[laplacian.pattern.column[i]]);
    const double shift = std::max(1e-9 * largest, 1e-300);
    std::vector<double> shifted = laplacian.values;
    for (int i = 0; i < n; ++i) shifted[laplacian.pattern.column[i]] += shift;
    SparseCholesky factor(laplacian.pattern);
    factor.factorize(shifted);

    MatrixXd x = scattered_block(n, block);
    std::vector<double> column(n);
    for (int step = 0; step < max_steps; ++step) {
        for (int c = 0; c < block; ++c) {
            VectorXd::Map(column.data(), n) = x.col(c);
            factor.solve(column);
            x.col(c) = VectorXd::Map(column.data(), n);
        }
        x = Eigen::HouseholderQR<MatrixXd>(x).householderQ() * MatrixXd::Identity(n, block);
        const MatrixXd lx = laplacian.times(x);
        const Eigen::SelfAdjointEigenSolver<MatrixXd> small(x.transpose() * lx);
        x = x * small.eigenvectors();
        const VectorXd& values = small.eigenvalues();
        if (block > k && values[k] < 100 * shift && step > 2)
            throw arcsim::NumericalError("spectral split: the weights fall apart into more than " + std::to_string(k) +
                                         " pieces. Lower the contrast p, or use spectral_stable.");
        const MatrixXd residual = lx * small.eigenvectors().leftCols(k) - x.leftCols(k) * values.head(k).asDiagonal();
        if (residual.norm() > enough * std::max(values[k - 1], shift)) continue;
        LowModes modes;
        for (int c = 0; c < k; ++c) {
            modes.value.push_back(values[c]);
            modes.vector.emplace_back(x.col(c).begin(), x.col(c).end());
        }
        return modes;
    }
    throw arcsim::NumericalError("spectral split: the eigenvectors do not converge. Lower the contrast p, or use spectral_stable.");
}

}  // namespace formwork
