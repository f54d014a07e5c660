#include "tests/formwork/segment/sample_surfaces.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace formwork::samples {
namespace {

using std::numbers::pi;

/// Each node to the mean of its neighbours, rim nodes along the rim; the same for every node.
void smooth(Surface& s, int steps) {
    std::map<std::pair<int, int>, int> uses;
    for (const auto& f : s.faces)
        for (int k = 0; k < 3; ++k) {
            const int a = f[k], b = f[(k + 1) % 3];
            ++uses[{std::min(a, b), std::max(a, b)}];
        }
    std::vector<char> rim(s.x.size(), 0);
    for (const auto& [e, n] : uses)
        if (n == 1) rim[e.first] = rim[e.second] = 1;
    for (int step = 0; step < steps; ++step) {
        std::vector<Vector3d> sum(s.x.size(), Vector3d::Zero());
        std::vector<int> count(s.x.size(), 0);
        for (const auto& [e, n] : uses)
            for (const auto& [a, b] : {e, std::pair{e.second, e.first}}) {
                if (rim[a] && n != 1) continue;
                sum[a] += s.x[b];
                ++count[a];
            }
        for (std::size_t v = 0; v < s.x.size(); ++v) s.x[v] = 0.5 * s.x[v] + 0.5 * sum[v] / count[v];
    }
}

struct NodeMap {
    Surface& s;
    std::map<std::array<long, 3>, int> index;
    int operator()(const Vector3d& x) {
        const std::array<long, 3> key{std::lround(x[0] * 1e6), std::lround(x[1] * 1e6), std::lround(x[2] * 1e6)};
        const auto [it, is_new] = index.emplace(key, s.n_nodes());
        if (is_new) s.x.push_back(x);
        return it->second;
    }
};

void add_quad(Surface& s, int a, int b, int c, int d, bool other_diagonal) {
    if (other_diagonal) {
        s.faces.push_back({a, b, d});
        s.faces.push_back({b, c, d});
    } else {
        s.faces.push_back({a, b, c});
        s.faces.push_back({a, c, d});
    }
}

}  // namespace

Surface cubes(int nx, int ny, int nz, int n, const std::function<bool(int, int, int)>& filled,
              const std::function<bool(int, int, int, int, int)>& open) {
    Surface s;
    NodeMap node{s, {}};
    const auto inside = [&](int i, int j, int k) {
        return i >= 0 && j >= 0 && k >= 0 && i < nx && j < ny && k < nz && filled(i, j, k);
    };
    for (int i = 0; i < nx; ++i)
        for (int j = 0; j < ny; ++j)
            for (int k = 0; k < nz; ++k)
                for (int axis = 0; inside(i, j, k) && axis < 3; ++axis)
                    for (int side : {-1, 1}) {
                        std::array<int, 3> other{i, j, k};
                        other[axis] += side;
                        if (inside(other[0], other[1], other[2])) continue;
                        if (open && open(i, j, k, axis, side)) continue;
                        Vector3d corner(i, j, k), u = Vector3d::Zero(), v = Vector3d::Zero();
                        u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1.0 / n;
                        if (side > 0) corner[axis] += 1;
                        else std::swap(u, v);
                        for (int p = 0; p < n; ++p)
                            for (int q = 0; q < n; ++q) {
                                const Vector3d x = corner + p * u + q * v;
                                add_quad(s, node(x), node(x + u), node(x + u + v), node(x + v), (p + q) % 2);
                            }
                    }
    smooth(s, n);
    return s;
}

Surface slab_with_holes(int genus, int n) {
    return cubes(2 * genus + 1, 3, 1, n, [](int i, int j, int) { return !(i % 2 == 1 && j == 1); });
}

Surface icosphere(int levels) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    Surface s;
    s.x = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g},
           {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
    s.faces = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
               {11, 10, 2}, {10, 7, 6}, {7, 1, 8}, {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8},
               {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}};
    for (Vector3d& x : s.x) x.normalize();
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<int, int>, int> middle;
        const auto mid = [&](int a, int b) {
            const auto [it, is_new] = middle.emplace(std::minmax(a, b), s.n_nodes());
            if (is_new) s.x.push_back((s.x[a] + s.x[b]).normalized());
            return it->second;
        };
        std::vector<arcsim::Triangle> finer;
        for (const auto& f : s.faces) {
            const int a = mid(f[0], f[1]), b = mid(f[1], f[2]), c = mid(f[2], f[0]);
            finer.insert(finer.end(), {{f[0], a, c}, {a, f[1], b}, {c, b, f[2]}, {a, b, c}});
        }
        s.faces = std::move(finer);
    }
    return s;
}

Surface grid(int n, int m, double h) {
    Surface s;
    for (int j = 0; j <= m; ++j)
        for (int i = 0; i <= n; ++i) s.x.emplace_back(i * h, j * h, 0);
    for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i;
            add_quad(s, a, a + 1, a + n + 2, a + n + 1, (i + j) % 2);
        }
    return s;
}

Surface torus(int around, int tube_count, double major, double minor) {
    Surface s;
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < tube_count; ++j) {
            const double u = 2 * pi * i / around, v = 2 * pi * j / tube_count, r = major + minor * std::cos(v);
            s.x.emplace_back(r * std::cos(u), r * std::sin(u), minor * std::sin(v));
        }
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < tube_count; ++j) {
            const int i1 = (i + 1) % around, j1 = (j + 1) % tube_count;
            add_quad(s, i * tube_count + j, i1 * tube_count + j, i1 * tube_count + j1, i * tube_count + j1, (i + j) % 2);
        }
    return s;
}

Surface tube(int around, int along, double radius, double height) {
    Surface s;
    for (int j = 0; j <= along; ++j)
        for (int i = 0; i < around; ++i) {
            const double u = 2 * pi * i / around;
            s.x.emplace_back(radius * std::cos(u), radius * std::sin(u), height * j / along);
        }
    for (int j = 0; j < along; ++j)
        for (int i = 0; i < around; ++i) {
            const int a = j * around + i, b = j * around + (i + 1) % around;
            add_quad(s, a, b, b + around, a + around, (i + j) % 2);
        }
    return s;
}

}  // namespace formwork::samples
