#include "formwork/flatten/isometry_energy.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace formwork {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// F = q R + r S with a rotation R and a reflection S: the singular values are q + r and q - r (with the determinant's sign),
/// and (R + S) / 2 and (R - S) / 2 the products of their vectors.
struct Rotations {
    double q, r;
    Matrix2d R, S;
};

Rotations split_rotation(const Matrix2d& f) {
    const double e = (f(0, 0) + f(1, 1)) / 2, k = (f(1, 0) - f(0, 1)) / 2;
    const double g = (f(0, 0) - f(1, 1)) / 2, h = (f(1, 0) + f(0, 1)) / 2;
    Rotations d{std::sqrt(e * e + k * k), std::sqrt(g * g + h * h), Matrix2d::Identity(), Matrix2d::Identity()};
    if (d.q > 0) d.R << e / d.q, -k / d.q, k / d.q, e / d.q;
    if (d.r > 0)
        d.S << g / d.r, h / d.r, h / d.r, -g / d.r;
    else
        d.S << 1, 0, 0, -1;
    return d;
}

/// d<M, F>/du of a face's six coordinates, F = [u1-u0, u2-u0] D⁻¹.
Vector6d pulled_back(const Matrix2d& m, const Matrix2d& inverse) {
    const Matrix2d g = m * inverse.transpose();
    Vector6d v;
    v << -g.col(0) - g.col(1), g.col(0), g.col(1);
    return v;
}

int local_dof(const Triangle& t, int k) { return 2 * t[k / 2] + k % 2; }

double slope(double s) { return 2 * s - 2 / (s * s * s); }        // of s² + 1/s²
double curvature(double s) { return 2 + 6 / (s * s * s * s); }

}  // namespace

IsometryEnergy::IsometryEnergy(const std::vector<Triangle>& faces, const std::vector<Matrix2d>& shapes, int n, double peak)
    : faces_(faces), pattern_(2 * n, 2 * n), peak_(peak) {
    double total = 0;
    for (const Matrix2d& d : shapes) {
        inverse_.push_back(d.inverse());
        weight_.push_back(d.determinant() / 2);
        total += weight_.back();
    }
    for (double& w : weight_) w /= total;

    find_pattern(n);

    double sum = 0;   // at an isometry the Hessian per face is close to 8 A BᵀB, vec(F) = B du
    for (std::size_t f = 0; f < faces_.size(); ++f)
        sum += 16 * weight_[f] * (inverse_[f].squaredNorm() + inverse_[f].colwise().sum().squaredNorm());
    diagonal_scale_ = sum / (2 * n);
}

/// Columns of the lower triangle: a node's two coordinates with themselves and with those of its higher neighbours.
void IsometryEnergy::find_pattern(int n) {
    std::vector<int> start(n + 1, 0);   // per node: its neighbours of higher number
    const auto each_edge = [&](auto&& body) {
        for (const Triangle& t : faces_)
            for (int k = 0; k < 3; ++k) body(std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3]));
    };
    each_edge([&](int lo, int) { ++start[lo + 1]; });
    for (int i = 0; i < n; ++i) start[i + 1] += start[i];
    std::vector<int> higher(start[n]), end(start.begin(), start.end() - 1);
    each_edge([&](int lo, int hi) { higher[end[lo]++] = hi; });
    int size = 0;
    for (int i = 0; i < n; ++i) {   // edges inside the disk came twice
        std::sort(higher.begin() + start[i], higher.begin() + end[i]);
        end[i] = static_cast<int>(std::unique(higher.begin() + start[i], higher.begin() + end[i]) - higher.begin());
        size += 3 + 4 * (end[i] - start[i]);
    }
    pattern_.resizeNonZeros(size);
    int* column = pattern_.outerIndexPtr();
    int* row = pattern_.innerIndexPtr();
    std::fill(pattern_.valuePtr(), pattern_.valuePtr() + size, 0.0);
    int at = 0;
    for (int i = 0; i < n; ++i)
        for (int axis = 0; axis < 2; ++axis) {
            column[2 * i + axis] = at;
            diagonal_.push_back(at);
            for (int other = axis; other < 2; ++other) row[at++] = 2 * i + other;
            for (int k = start[i]; k < end[i]; ++k)
                for (int other = 0; other < 2; ++other) row[at++] = 2 * higher[k] + other;
        }
    column[2 * n] = at;

    const auto find = [&](int p, int q) {   // degrees of freedom
        const int i = std::min(p, q) / 2, j = std::max(p, q) / 2, lo = std::min(p, q);
        if (i == j) return column[lo] + std::max(p, q) - lo;
        const auto place = std::lower_bound(higher.begin() + start[i], higher.begin() + end[i], j) - (higher.begin() + start[i]);
        return column[lo] + (lo % 2 == 0 ? 2 : 1) + 2 * static_cast<int>(place) + std::max(p, q) % 2;
    };
    slot_.reserve(faces_.size());
    for (const Triangle& t : faces_) {
        std::array<int, 21> slots;
        int next = 0;
        for (int a = 0; a < 6; ++a)
            for (int b = 0; b <= a; ++b) slots[next++] = find(local_dof(t, a), local_dof(t, b));
        slot_.push_back(slots);
    }
}

void IsometryEnergy::assemble_conformal(Eigen::SparseMatrix<double>& hessian) const {
    hessian = pattern_;
    double* values = hessian.valuePtr();
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        const auto add = [&](int p, int q, double w) {   // local degrees of freedom
            const int a = std::max(p, q), b = std::min(p, q);
            values[slot_[f][a * (a + 1) / 2 + b]] += w;
        };
        const Matrix2d shape = inverse_[f].inverse();
        const std::array<Vector2d, 3> x{Vector2d::Zero(), shape.col(0), shape.col(1)};
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            const double w = 0.5 * (x[i] - x[k]).dot(x[j] - x[k]) / shape.determinant();   // cot / 2
            for (int axis = 0; axis < 2; ++axis) {
                add(2 * i + axis, 2 * i + axis, w);
                add(2 * j + axis, 2 * j + axis, w);
                add(2 * i + axis, 2 * j + axis, -w);
            }
            add(2 * i, 2 * j + 1, -0.5);   // minus the area, 1/2 sum (x_i y_j - x_j y_i); exact in cancelling inside
            add(2 * j, 2 * i + 1, 0.5);
        }
    }
    for (int slot : diagonal_)
        if (values[slot] == 0) values[slot] = 1;   // of a node without faces
}

Matrix2d IsometryEnergy::deformation(const VectorXd& u, int f) const {
    const Triangle& t = faces_[f];
    Matrix2d edges;
    edges.col(0) = u.segment<2>(2 * t[1]) - u.segment<2>(2 * t[0]);
    edges.col(1) = u.segment<2>(2 * t[2]) - u.segment<2>(2 * t[0]);
    return edges * inverse_[f];
}

double IsometryEnergy::value(const VectorXd& u) const {
    double sum = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        const Matrix2d F = deformation(u, static_cast<int>(f));
        const double det = F.determinant(), norm2 = F.squaredNorm();
        if (!(det > 0)) return std::numeric_limits<double>::infinity();
        const double e = norm2 + norm2 / (det * det) - 4;
        sum += weight_[f] * (e + peak_ * e * e);
    }
    return sum;
}

double IsometryEnergy::assemble(const VectorXd& u, double shift, VectorXd& gradient,
                                Eigen::SparseMatrix<double>& hessian) const {
    if (hessian.nonZeros() != pattern_.nonZeros()) hessian = pattern_;
    double* values = hessian.valuePtr();
    std::fill(values, values + hessian.nonZeros(), 0.0);
    for (int slot : diagonal_) values[slot] = shift;
    gradient = VectorXd::Zero(u.size());
    double sum = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        const Triangle& t = faces_[f];
        const Rotations d = split_rotation(deformation(u, static_cast<int>(f)));
        const double s1 = d.q + d.r, s2 = d.q - d.r;
        const double e = s1 * s1 + s2 * s2 + 1 / (s1 * s1) + 1 / (s2 * s2) - 4;
        sum += weight_[f] * (e + peak_ * e * e);
        const double slope_of_peak = 1 + 2 * peak_ * e;   // d(e + k e²)/de

        // Eigenmatrices of the energy in the frame of the singular vectors.
        const Matrix2d first = 0.5 * (d.R + d.S), second = 0.5 * (d.R - d.S);
        Matrix2d quarter;
        quarter << 0, -1, 1, 0;
        const Matrix2d twist = std::sqrt(0.5) * quarter * d.R, flip = std::sqrt(0.5) * quarter * d.S;
        const double g1 = slope(s1), g2 = slope(s2);
        const double twist_value = std::max(0.0, (g1 + g2) / (s1 + s2));
        const double p = s1 * s2;   // (g1 - g2) / (s1 - s2) without the cancellation
        const double flip_value = 2 + 2 * (s1 * s1 + p + s2 * s2) / (p * p * p);

        const Vector6d gradient_of_e = pulled_back(g1 * first + g2 * second, inverse_[f]);
        const Vector6d gradient_f = weight_[f] * slope_of_peak * gradient_of_e;
        Eigen::Matrix<double, 6, 6> h = Eigen::Matrix<double, 6, 6>::Zero();
        const auto add = [&](double value, const Vector6d& m) {
            for (int i = 0; i < 6; ++i)
                for (int j = 0; j <= i; ++j) h(i, j) += value * m[i] * m[j];
        };
        const double w = weight_[f] * slope_of_peak;
        add(w * curvature(s1), pulled_back(first, inverse_[f]));
        add(w * curvature(s2), pulled_back(second, inverse_[f]));
        add(w * twist_value, pulled_back(twist, inverse_[f]));
        add(w * flip_value, pulled_back(flip, inverse_[f]));
        if (peak_ > 0) add(2 * weight_[f] * peak_, gradient_of_e);

        for (int k = 0; k < 6; ++k) gradient[local_dof(t, k)] += gradient_f[k];
        int next = 0;
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j <= i; ++j) values[slot_[f][next++]] += h(i, j);
    }
    return sum;
}

double IsometryEnergy::largest_step(const VectorXd& u, const VectorXd& du) const {
    double largest = std::numeric_limits<double>::infinity();
    for (const Triangle& t : faces_) {
        const Eigen::Vector2d a = u.segment<2>(2 * t[1]) - u.segment<2>(2 * t[0]);
        const Eigen::Vector2d b = u.segment<2>(2 * t[2]) - u.segment<2>(2 * t[0]);
        const Eigen::Vector2d da = du.segment<2>(2 * t[1]) - du.segment<2>(2 * t[0]);
        const Eigen::Vector2d db = du.segment<2>(2 * t[2]) - du.segment<2>(2 * t[0]);
        const auto cross = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) { return p.x() * q.y() - p.y() * q.x(); };
        // The doubled area along the step: c0 + c1 t + c2 t², c0 > 0; the smallest positive root counts.
        const double c0 = cross(a, b), c1 = cross(a, db) + cross(da, b), c2 = cross(da, db);
        const double discriminant = c1 * c1 - 4 * c2 * c0;
        if (discriminant < 0) continue;
        const double q = -0.5 * (c1 + std::copysign(std::sqrt(discriminant), c1));
        for (double root : {q != 0 ? c0 / q : -1.0, c2 != 0 ? q / c2 : -1.0})
            if (root > 0) largest = std::min(largest, root);
    }
    return std::min(1.0, 0.9 * largest);
}

double IsometryEnergy::best_scale(const VectorXd& u) const {
    double a = 0, b = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        const Matrix2d F = deformation(u, static_cast<int>(f));
        const double det = F.determinant(), norm2 = F.squaredNorm();
        a += weight_[f] * norm2;
        b += weight_[f] * norm2 / (det * det);
    }
    return std::pow(b / a, 0.25);
}

}  // namespace formwork
