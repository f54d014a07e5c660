#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "formwork/flatten/flatten.hpp"

namespace formwork {
namespace {

/// Singular values of the map flat -> surface, larger first; the second is negative for a flipped face.
std::array<double, 2> stretches(const Triangle& t, const Matrix2d& shape, const std::vector<Vector2d>& u) {
    Matrix2d flat;
    flat << u[t[1]] - u[t[0]], u[t[2]] - u[t[0]];
    const Matrix2d g = shape * flat.inverse();
    const double q = std::hypot(g(0, 0) + g(1, 1), g(1, 0) - g(0, 1)) / 2;
    const double r = std::hypot(g(0, 0) - g(1, 1), g(1, 0) + g(0, 1)) / 2;
    return {q + r, q - r};
}

double distortion(const std::array<double, 2>& s) {
    if (!(s[1] > 0) || !std::isfinite(s[0])) return std::numeric_limits<double>::infinity();
    return std::max(std::abs(s[0] - 1), std::abs(s[1] - 1));
}

}  // namespace

std::vector<double> face_distortions(const std::vector<Triangle>& faces, const std::vector<Matrix2d>& shapes,
                                     const std::vector<Vector2d>& u) {
    std::vector<double> d(faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) d[f] = distortion(stretches(faces[f], shapes[f], u));
    return d;
}

StretchStatistics measure_stretch(const std::vector<Triangle>& faces, const std::vector<Matrix2d>& shapes,
                                  const std::vector<Vector2d>& u) {
    StretchStatistics result;
    const std::vector<double> d = face_distortions(faces, shapes, u);
    double area = 0, flat_area = 0, energy = 0, within = 0;
    std::vector<double> weight(faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const std::array<double, 2> s = stretches(faces[f], shapes[f], u);
        const double a = weight[f] = shapes[f].determinant() / 2;
        area += a;
        flat_area += a / (s[0] * s[1]);
        energy += a * (s[0] * s[0] + s[1] * s[1] + 1 / (s[0] * s[0]) + 1 / (s[1] * s[1]));
        result.mean += a * d[f];
        result.max = std::max(result.max, d[f]);
        if (d[f] <= 0.05) within += a;
        if (!std::isfinite(d[f])) ++result.flips;
    }
    if (!(area > 0)) return result;
    result.mean /= area;
    result.within_5_percent = within / area;
    result.symmetric_dirichlet = energy / area;
    result.area_change = flat_area / area - 1;

    std::vector<int> order(faces.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return d[a] < d[b]; });
    double below = 0;
    for (int f : order) {
        below += weight[f];
        result.p95 = d[f];
        if (below >= 0.95 * area) break;
    }
    return result;
}

}  // namespace formwork
