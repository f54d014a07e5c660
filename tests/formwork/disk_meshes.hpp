#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "arcsim/mesh/surface.hpp"

/// Small surfaces with known answers, made on the spot.
namespace disk_meshes {

using arcsim::Surface;
using arcsim::Vector2d;
using arcsim::Vector3d;

/// A grid of (n+1) x (m+1) nodes over the unit square, mapped by `shape`, split along one diagonal.
inline Surface patch(int n, int m, const std::function<Vector3d(double, double)>& shape) {
    Surface s;
    for (int j = 0; j <= m; ++j)
        for (int i = 0; i <= n; ++i) s.x.push_back(shape(double(i) / n, double(j) / m));
    const auto node = [&](int i, int j) { return j * (n + 1) + i; };
    for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i) {
            s.faces.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
            s.faces.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
        }
    return s;
}

/// A cap of the unit sphere around +z: a pole and `rings` rings of `around` nodes up to the polar angle phi.
inline Surface cap(int rings, int around, double phi) {
    Surface s;
    s.x.emplace_back(0, 0, 1);
    for (int j = 1; j <= rings; ++j)
        for (int i = 0; i < around; ++i) {
            const double p = phi * j / rings, a = 2 * M_PI * (i + 0.5 * (j % 2)) / around;
            s.x.emplace_back(std::sin(p) * std::cos(a), std::sin(p) * std::sin(a), std::cos(p));
        }
    const auto node = [&](int j, int i) { return 1 + (j - 1) * around + (i % around); };
    for (int i = 0; i < around; ++i) s.faces.push_back({0, node(1, i), node(1, i + 1)});
    for (int j = 1; j < rings; ++j)
        for (int i = 0; i < around; ++i) {
            if (j % 2) {   // odd rings are shifted by half a step
                s.faces.push_back({node(j, i), node(j + 1, i + 1), node(j, i + 1)});
                s.faces.push_back({node(j, i), node(j + 1, i), node(j + 1, i + 1)});
            } else {
                s.faces.push_back({node(j, i), node(j + 1, i), node(j, i + 1)});
                s.faces.push_back({node(j, i + 1), node(j + 1, i), node(j + 1, i + 1)});
            }
        }
    return s;
}

/// The unit sphere from an icosahedron split `levels` times.
inline Surface icosphere(int levels) {
    Surface s;
    const double g = (1 + std::sqrt(5.0)) / 2;
    for (double a : {-1.0, 1.0})
        for (double b : {-g, g}) {
            s.x.emplace_back(0, a, b);
            s.x.emplace_back(a, b, 0);
            s.x.emplace_back(b, 0, a);
        }
    for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j)
            for (int k = 0; k < 12; ++k) {
                const auto near = [&](int p, int q) { return std::abs((s.x[p] - s.x[q]).norm() - 2) < 1e-9; };
                if (i < j && i < k && near(i, j) && near(j, k) && near(k, i) &&
                    (s.x[j] - s.x[i]).cross(s.x[k] - s.x[i]).dot(s.x[i]) > 0)
                    s.faces.push_back({i, j, k});
            }
    for (Vector3d& p : s.x) p.normalize();
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<int, int>, int> middle;
        const auto split = [&](int a, int b) {
            const auto [it, fresh] = middle.try_emplace({std::min(a, b), std::max(a, b)}, s.n_nodes());
            if (fresh) s.x.push_back((s.x[a] + s.x[b]).normalized());
            return it->second;
        };
        std::vector<arcsim::Triangle> fine;
        for (const auto& t : s.faces) {
            const int a = split(t[0], t[1]), b = split(t[1], t[2]), c = split(t[2], t[0]);
            fine.insert(fine.end(), {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}});
        }
        s.faces = fine;
    }
    return s;
}

}  // namespace disk_meshes
