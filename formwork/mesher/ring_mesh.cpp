#include "formwork/mesher/ring_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace formwork {

void RingMesh::add_ring(const std::vector<Vector3d>& ring) {
    std::vector<int> next;
    for (const Vector3d& p : ring) {
        next.push_back(surface_.n_nodes());
        surface_.x.push_back(p);
    }
    const int n = static_cast<int>(last_.size()), m = static_cast<int>(next.size());
    if (n == 1 && m > 1)
        for (int j = 0; j < m; ++j) surface_.faces.push_back({last_[0], next[(j + 1) % m], next[j]});
    if (n > 1 && m == 1)
        for (int i = 0; i < n; ++i) surface_.faces.push_back({last_[i], last_[(i + 1) % n], next[0]});
    if (n > 1 && m > 1) {
        // Walk around both rings; the shorter of the two possible diagonals decides which side advances.
        const auto x = [&](int node) { return surface_.x[node]; };
        int start = 0;
        for (int j = 1; j < m; ++j)
            if ((x(next[j]) - x(last_[0])).norm() < (x(next[start]) - x(last_[0])).norm()) start = j;
        for (int i = 0, j = 0; i < n || j < m;) {
            const int a = last_[i % n], a1 = last_[(i + 1) % n];
            const int b = next[(start + j) % m], b1 = next[(start + j + 1) % m];
            const bool lower = j == m || (i < n && (x(a1) - x(b)).norm() <= (x(b1) - x(a)).norm());
            surface_.faces.push_back(lower ? Triangle{a, a1, b} : Triangle{a, b1, b});
            ++(lower ? i : j);
        }
    }
    last_ = std::move(next);
}

namespace {

double perimeter(const SweptSection& section, double s) {
    constexpr int samples = 96;
    double length = 0;
    for (int i = 0; i < samples; ++i)
        length += (section.point(s, (i + 1.0) / samples) - section.point(s, static_cast<double>(i) / samples)).norm();
    return length;
}

/// Cuts [s0, s1] into pieces of equal length along the surface, averaged over a few meridians.
std::vector<double> equal_steps(const SweptSection& section, double s0, double s1, double step) {
    constexpr int samples = 200, meridians = 8;
    std::vector<double> length(samples + 1, 0);
    for (int i = 1; i <= samples; ++i) {
        const double a = s0 + (s1 - s0) * (i - 1) / samples, b = s0 + (s1 - s0) * i / samples;
        double d = 0;
        for (int k = 0; k < meridians; ++k) {
            const double t = static_cast<double>(k) / meridians;
            d += (section.point(b, t) - section.point(a, t)).norm() / meridians;
        }
        length[i] = length[i - 1] + d;
    }
    const int rows = std::max(1, static_cast<int>(std::lround(length.back() / step)));
    std::vector<double> s;
    for (int r = 1, i = 1; r <= rows; ++r) {
        const double target = length.back() * r / rows;
        while (i < samples && length[i] < target) ++i;
        const double span = length[i] - length[i - 1];
        const double f = span > 0 ? std::clamp((target - length[i - 1]) / span, 0.0, 1.0) : 1.0;
        s.push_back(r == rows ? s1 : s0 + (s1 - s0) * (i - 1 + f) / samples);
    }
    return s;
}

}  // namespace

Surface mesh_swept_section(const SweptSection& section, double edge) {
    const double row = edge * std::sqrt(3.0) / 2;   // height of an equilateral triangle
    std::vector<double> rings{section.breaks().front()};
    const std::vector<double> breaks = section.breaks();
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
        for (const double s : equal_steps(section, breaks[k], breaks[k + 1], row)) rings.push_back(s);

    RingMesh mesh;
    int row_number = 0;
    int previous = 0;
    for (const double s : rings) {
        const double around = perimeter(section, s);
        if (around < 1e-9) {
            mesh.add_pole(section.point(s, 0));
            previous = 0;
            continue;
        }
        // Near a pole rings of 6, 12, 18 ... fit best; elsewhere the count follows the perimeter and small
        // changes are left out, since each unpaired point makes a pair of less regular triangles.
        int n = std::max(6, 6 * static_cast<int>(std::lround(around / edge / 6)));
        if (previous > 0 && std::abs(around / edge - previous) < 3.5) n = previous;
        const double shift = row_number % 2 == 0 ? 0 : 0.5;   // rows stand on gaps, as bricks do
        std::vector<Vector3d> ring;
        for (int i = 0; i < n; ++i) ring.push_back(section.point(s, (i + shift) / n));
        mesh.add_ring(ring);
        previous = n;
        ++row_number;
    }
    return mesh.take();
}

}  // namespace formwork
