#include "formwork/flatten/start_map.hpp"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <cmath>
#include <numeric>

namespace formwork {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Corner k of a face in its own plane.
Vector2d corner(const Matrix2d& shape, int k) {
    if (k == 0) return Vector2d::Zero();
    return k == 1 ? Vector2d(shape.col(0)) : Vector2d(shape.col(1));
}

double edge_length(const Matrix2d& shape, int from, int to) { return (corner(shape, to) - corner(shape, from)).norm(); }

/// Distance along the outline up to each of its vertices; the last entry is the perimeter.
std::vector<double> arc_lengths(const std::vector<Triangle>& faces, const std::vector<Matrix2d>& shapes,
                                const std::vector<int>& outline, int n) {
    std::vector<int> place(n, -1);   // in the outline
    for (std::size_t i = 0; i < outline.size(); ++i) place[outline[i]] = static_cast<int>(i);
    std::vector<double> s(outline.size() + 1, 0);
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int i = place[faces[f][k]];
            if (i >= 0 && faces[f][(k + 1) % 3] == outline[(i + 1) % outline.size()]) s[i + 1] = edge_length(shapes[f], k, (k + 1) % 3);
        }
    std::partial_sum(s.begin(), s.end(), s.begin());
    return s;
}

/// tan(angle / 2) at corner k, from lengths and area.
double half_tangent(const Matrix2d& shape, int k) {
    const Vector2d a = corner(shape, (k + 1) % 3) - corner(shape, k);
    const Vector2d b = corner(shape, (k + 2) % 3) - corner(shape, k);
    return std::abs(shape.determinant()) / (a.norm() * b.norm() + a.dot(b));
}

}  // namespace

VectorXd conformal_map(const std::vector<Triangle>& faces, const std::vector<Matrix2d>& shapes, const std::vector<int>& outline,
                       int n, const IsometryEnergy& energy, FlatteningSolver& solver) {
    Sparse a;
    energy.assemble_conformal(a);
    // Pins half a perimeter apart: far from each other on any outline, and independent of the embedding.
    const std::vector<double> s = arc_lengths(faces, shapes, outline, n);
    std::size_t half = 1;
    while (half + 1 < outline.size() && s[half] < s.back() / 2) ++half;
    std::vector<char> fixed(2 * n, 0);
    VectorXd u = VectorXd::Zero(2 * n);
    for (int pin : {outline[0], outline[half]}) fixed[2 * pin] = fixed[2 * pin + 1] = 1;
    u[2 * outline[half]] = s.back() / 4;   // the scale is free and chosen later
    VectorXd b = u;
    for (int c = 0; c < a.cols(); ++c)
        for (Sparse::InnerIterator it(a, c); it; ++it) {
            const int r = static_cast<int>(it.row());
            if (!fixed[r] && !fixed[c]) continue;
            if (!fixed[r]) b[r] -= it.value() * u[c];
            if (!fixed[c]) b[c] -= it.value() * u[r];
            it.valueRef() = r == c ? 1 : 0;
        }
    solver.analyzePattern(a);
    solver.factorize(a);   // an indefinite matrix is an answer here: the circle map takes over
    if (solver.info() != Eigen::Success) return VectorXd::Zero(2 * n);
    return solver.solve(b);
}

VectorXd circle_map(const std::vector<Triangle>& faces, const std::vector<Matrix2d>& shapes,
                    const std::vector<int>& outline, int n, TutteWeights weights) {
    const std::vector<double> s = arc_lengths(faces, shapes, outline, n);
    const double radius = s.back() / (2 * M_PI);
    VectorXd u = VectorXd::Zero(2 * n);
    std::vector<char> used(n, 0);
    for (const Triangle& t : faces)
        for (int i : t) used[i] = 1;
    std::vector<int> unknown(n, -1);
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const double angle = s[i] / radius;
        u.segment<2>(2 * outline[i]) = radius * Vector2d(std::cos(angle), std::sin(angle));
        used[outline[i]] = 0;
    }
    int size = 0;
    for (int i = 0; i < n; ++i)
        if (used[i]) unknown[i] = size++;
    if (size == 0) return u;

    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX2d b = Eigen::MatrixX2d::Zero(size, 2);
    const auto add = [&](int i, int j, double w) {   // row i: sum_j w_ij (u_i - u_j) = 0
        if (unknown[i] < 0) return;
        entries.emplace_back(unknown[i], unknown[i], w);
        if (unknown[j] < 0)
            b.row(unknown[i]) += w * u.segment<2>(2 * j).transpose();
        else
            entries.emplace_back(unknown[i], unknown[j], -w);
    };
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            const double t = weights == TutteWeights::uniform ? 1 : half_tangent(shapes[f], k);
            for (int side : {1, 2}) {
                const int other = (k + side) % 3;
                const double length = weights == TutteWeights::uniform ? 1 : edge_length(shapes[f], k, other);
                add(faces[f][k], faces[f][other], t / length);
            }
        }
    Sparse a(size, size);
    a.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseLU<Sparse> solver(a);
    if (solver.info() != Eigen::Success) return VectorXd::Zero(2 * n);
    const Eigen::MatrixX2d x = solver.solve(b);
    for (int i = 0; i < n; ++i)
        if (unknown[i] >= 0) u.segment<2>(2 * i) = x.row(unknown[i]).transpose();
    return u;
}

}  // namespace formwork
