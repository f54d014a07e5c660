#include "formwork/flatten/start_map.hpp"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <cmath>
#include <map>
#include <utility>

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
                                const std::vector<int>& outline) {
    std::map<std::pair<int, int>, double> length;   // of every half edge
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (int k = 0; k < 3; ++k)
            length[{faces[f][k], faces[f][(k + 1) % 3]}] = edge_length(shapes[f], k, (k + 1) % 3);
    std::vector<double> s{0};
    for (std::size_t i = 0; i < outline.size(); ++i)
        s.push_back(s.back() + length.at({outline[i], outline[(i + 1) % outline.size()]}));
    return s;
}

/// tan(angle / 2) at corner k, from lengths and area.
double half_tangent(const Matrix2d& shape, int k) {
    const Vector2d a = corner(shape, (k + 1) % 3) - corner(shape, k);
    const Vector2d b = corner(shape, (k + 2) % 3) - corner(shape, k);
    return std::abs(shape.determinant()) / (a.norm() * b.norm() + a.dot(b));
}

}  // namespace

VectorXd conformal_map(const std::vector<Triangle>& faces, const std::vector<Matrix2d>& shapes,
                       const std::vector<int>& outline, int n) {
    // E = 1/4 sum cot |du|² - area, whose kernel is the similarities; two pins remove it.
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](int i, int j, double w) { entries.emplace_back(i, j, w); };
    std::vector<char> used(n, 0);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const Triangle& t = faces[f];
        for (int k = 0; k < 3; ++k) {
            used[t[k]] = 1;
            const int i = t[(k + 1) % 3], j = t[(k + 2) % 3];
            const Vector2d a = corner(shapes[f], (k + 1) % 3) - corner(shapes[f], k);
            const Vector2d b = corner(shapes[f], (k + 2) % 3) - corner(shapes[f], k);
            const double w = 0.5 * a.dot(b) / shapes[f].determinant();   // cot / 2
            for (int axis = 0; axis < 2; ++axis) {
                add(2 * i + axis, 2 * i + axis, w);
                add(2 * j + axis, 2 * j + axis, w);
                add(2 * i + axis, 2 * j + axis, -w);
                add(2 * j + axis, 2 * i + axis, -w);
            }
        }
    }
    for (std::size_t i = 0; i < outline.size(); ++i) {   // minus the enclosed area, 1/2 sum (x_i y_j - x_j y_i)
        const int p = outline[i], q = outline[(i + 1) % outline.size()];
        add(2 * p, 2 * q + 1, -0.5), add(2 * q + 1, 2 * p, -0.5);
        add(2 * q, 2 * p + 1, 0.5), add(2 * p + 1, 2 * q, 0.5);
    }

    // Pins half a perimeter apart: far from each other on any outline, and independent of the embedding.
    const std::vector<double> s = arc_lengths(faces, shapes, outline);
    std::size_t half = 1;
    while (half + 1 < outline.size() && s[half] < s.back() / 2) ++half;
    VectorXd u = VectorXd::Zero(2 * n);
    u[2 * outline[half]] = s.back() / 4;   // the scale is free and chosen later
    std::vector<char> fixed(2 * n, 0);
    for (int pin : {outline[0], outline[half]}) fixed[2 * pin] = fixed[2 * pin + 1] = 1;

    std::vector<int> unknown(2 * n, -1);
    int size = 0;
    for (int i = 0; i < 2 * n; ++i)
        if (!fixed[i] && used[i / 2]) unknown[i] = size++;
    std::vector<Eigen::Triplet<double>> lower;
    VectorXd b = VectorXd::Zero(size);
    for (const auto& e : entries) {
        if (unknown[e.row()] < 0) continue;
        if (unknown[e.col()] < 0)
            b[unknown[e.row()]] -= e.value() * u[e.col()];
        else if (e.row() >= e.col())
            lower.emplace_back(unknown[e.row()], unknown[e.col()], e.value());
    }
    Sparse a(size, size);
    a.setFromTriplets(lower.begin(), lower.end());
    Eigen::CholmodDecomposition<Sparse, Eigen::Lower> solver;
    solver.cholmod().print = 0;   // an indefinite matrix is an answer here: the circle map takes over
    solver.compute(a);
    if (solver.info() != Eigen::Success) return VectorXd::Zero(2 * n);
    const VectorXd x = solver.solve(b);
    for (int i = 0; i < 2 * n; ++i)
        if (unknown[i] >= 0) u[i] = x[unknown[i]];
    return u;
}

VectorXd circle_map(const std::vector<Triangle>& faces, const std::vector<Matrix2d>& shapes,
                    const std::vector<int>& outline, int n, TutteWeights weights) {
    const std::vector<double> s = arc_lengths(faces, shapes, outline);
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
