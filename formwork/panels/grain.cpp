#include "formwork/panels/grain.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <limits>

namespace formwork {
namespace {

constexpr double no_data = 1e-9;   // mean weight below which the strain says nothing about a panel

double wrap_quarter(double angle) { return angle - M_PI / 2 * std::round(angle / (M_PI / 2)); }

/// Directions that the weave should follow, in the plane.
struct Targets {
    bool has_data = false;            // false: the smoothed field stands in for the strain
    std::vector<double> psi, weight;  // per face: angle from the first axis; area times importance
    double sum = 0;                   // of the weights
};

Targets flat_targets(const Segmentation& s, const std::vector<Matrix2d>& shapes, const FlatPanel& panel) {
    const std::size_t n = panel.faces.size();
    Targets t;
    double data = 0, total = 0;
    for (std::size_t f = 0; f < n; ++f) {
        const double area = shapes[f].determinant() / 2;
        t.weight.push_back(s.direction.empty() ? 0 : area * s.direction[panel.face[f]].weight);
        data += t.weight.back();
        total += area;
    }
    t.has_data = data > no_data * total;
    for (std::size_t f = 0; f < n; ++f) {
        const int face = panel.face[f];
        if (!t.has_data) t.weight[f] = s.field_theta.empty() ? 0 : shapes[f].determinant() / 2;
        const double theta = t.has_data ? s.direction[face].theta : s.field_theta.empty() ? 0 : s.field_theta[face];
        const Triangle& c = panel.faces[f];
        Matrix2d flat;
        flat << panel.u[c[1]] - panel.u[c[0]], panel.u[c[2]] - panel.u[c[0]];
        const Vector2d d = flat * shapes[f].inverse() * Vector2d(std::cos(theta), std::sin(theta));
        t.psi.push_back(std::atan2(d.y(), d.x()));
        t.sum += t.weight[f];
    }
    return t;
}

double extent(const std::vector<Vector2d>& points, double angle) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vector2d& p : points) {
        const double along = p.x() * std::cos(angle) + p.y() * std::sin(angle);
        low = std::min(low, along), high = std::max(high, along);
    }
    return high - low;
}

}  // namespace

void turn_to_grain(const Segmentation& s, const std::vector<Matrix2d>& shapes, WarpAlong warp, FlatPanel& panel) {
    const Targets t = flat_targets(s, shapes, panel);
    std::complex<double> fourfold = 0;
    for (std::size_t f = 0; f < t.psi.size(); ++f) fourfold += t.weight[f] * std::polar(1.0, 4 * t.psi[f]);
    double phi = std::arg(fourfold) / 4, twofold = 0;
    for (std::size_t f = 0; f < t.psi.size(); ++f) twofold += t.weight[f] * std::cos(2 * (t.psi[f] - phi));
    const bool across = t.has_data ? (twofold < 0) != (warp == WarpAlong::smallest_stretch)
                                   : extent(panel.u, phi) < extent(panel.u, phi + M_PI / 2);
    if (across) phi += M_PI / 2;
    const Eigen::Rotation2Dd turn(-phi);
    for (Vector2d& p : panel.u) p = turn * p;
}

void measure_grain(const Segmentation& s, const std::vector<Matrix2d>& shapes, FlatPanel& panel) {
    const Targets t = flat_targets(s, shapes, panel);
    std::complex<double> fourfold = 0;
    double deviation = 0;
    panel.grain_error_deg.clear();
    for (std::size_t f = 0; f < t.psi.size(); ++f) {
        fourfold += t.weight[f] * std::polar(1.0, 4 * t.psi[f]);
        panel.grain_error_deg.push_back(std::abs(wrap_quarter(t.psi[f])) * 180 / M_PI);
        deviation += t.weight[f] * panel.grain_error_deg.back();
    }
    panel.grain_coherence = t.sum > 0 ? std::abs(fourfold) / t.sum : 1;
    panel.grain_deviation_deg = t.sum > 0 ? deviation / t.sum : 0;
}

}  // namespace formwork
