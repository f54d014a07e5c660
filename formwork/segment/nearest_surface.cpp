#include "formwork/segment/nearest_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace formwork {

Vector3d nearest_in_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Vector3d ab = b - a, ac = c - a, n = ab.cross(ac);
    const double nn = n.squaredNorm();
    if (nn > 0) {   // barycentric coordinates of the foot of the perpendicular
        const double v = (p - a).cross(ac).dot(n) / nn, w = ab.cross(p - a).dot(n) / nn;
        if (v >= 0 && w >= 0 && v + w <= 1) return a + v * ab + w * ac;
    }
    Vector3d best = a;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) {
        const Vector3d d = to - from;
        const double length2 = d.squaredNorm();
        const double u = length2 > 0 ? std::clamp((p - from).dot(d) / length2, 0.0, 1.0) : 0.0;
        const Vector3d x = from + u * d;
        if (const double r = (x - p).squaredNorm(); r < least) least = r, best = x;
    }
    return best;
}

NearestSurface::NearestSurface(const Surface& s, const Topology& t) : s_(s), t_(t) {
    low_ = Vector3d::Constant(std::numeric_limits<double>::infinity());
    Vector3d high = -low_;
    for (const Vector3d& x : s.x) {
        low_ = low_.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    const double edge = arcsim::mean_edge_length(s);
    // About two nodes per occupied cell, and never more cells than some millions.
    size_ = std::max(1.5 * edge, (high - low_).maxCoeff() / 200);
    for (int k = 0; k < 3; ++k) count_[k] = std::max(1, static_cast<int>((high[k] - low_[k]) / size_) + 1);
    std::vector<int> cell(s.x.size());
    start_.assign(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2] + 1, 0);
    for (int v = 0; v < s.n_nodes(); ++v) {
        cell[v] = (cell_of(s.x[v][0], 0) * count_[1] + cell_of(s.x[v][1], 1)) * count_[2] + cell_of(s.x[v][2], 2);
        if (!t.node_faces[v].empty()) ++start_[cell[v] + 1];
    }
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    nodes_.resize(start_.back());
    std::vector<int> next(start_.begin(), start_.end() - 1);
    for (int v = 0; v < s.n_nodes(); ++v)
        if (!t.node_faces[v].empty()) nodes_[next[cell[v]]++] = v;
}

int NearestSurface::cell_of(double x, int axis) const {
    return std::clamp(static_cast<int>(std::floor((x - low_[axis]) / size_)), 0, count_[axis] - 1);
}

/// The cells at Chebyshev distance `ring` from p's.
template <class Body>
void NearestSurface::visit_cells(const Vector3d& p, int ring, Body&& body) const {
    const std::array<int, 3> c{cell_of(p[0], 0), cell_of(p[1], 1), cell_of(p[2], 2)};
    for (int i = std::max(0, c[0] - ring); i <= std::min(count_[0] - 1, c[0] + ring); ++i)
        for (int j = std::max(0, c[1] - ring); j <= std::min(count_[1] - 1, c[1] + ring); ++j) {
            const bool inside = std::abs(i - c[0]) < ring && std::abs(j - c[1]) < ring;
            for (int k = c[2] - ring; k <= c[2] + ring; k += inside && ring > 0 ? 2 * ring : 1)
                if (k >= 0 && k < count_[2]) body((i * count_[1] + j) * count_[2] + k);
        }
}

int NearestSurface::node(const Vector3d& p) const {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    // Outside of the grid the point's own cell is the nearest border cell: its distance comes on top.
    const int rings = *std::max_element(count_.begin(), count_.end());
    for (int ring = 0; ring <= rings; ++ring) {
        visit_cells(p, ring, [&](int cell) {
            for (int k = start_[cell]; k < start_[cell + 1]; ++k) {
                const int v = nodes_[k];
                const double r = (s_.x[v] - p).squaredNorm();
                if (r < least || (r == least && v < best)) least = r, best = v;
            }
        });
        const double safe = (ring - 1) * size_;   // nothing unseen is nearer than that
        if (best >= 0 && safe > 0 && safe * safe >= least) break;
    }
    return best;
}

NearestSurface::Hit NearestSurface::point(const Vector3d& p) const {
    const int nearest = node(p);
    Hit hit{-1, p, std::numeric_limits<double>::infinity()};
    const auto try_faces = [&](int v) {
        for (int f : t_.node_faces[v]) {
            const auto& t = s_.faces[f];
            const Vector3d x = nearest_in_triangle(p, s_.x[t[0]], s_.x[t[1]], s_.x[t[2]]);
            if (const double d = (x - p).norm(); d < hit.distance) hit = {f, x, d};
        }
    };
    try_faces(nearest);
    for (int f : t_.node_faces[nearest])
        for (int v : s_.faces[f])
            if (v != nearest) try_faces(v);
    return hit;
}

}  // namespace formwork
