#include "shapes.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace shapes {

using arcsim::Vector3d;
using std::numbers::pi;

namespace {

void hold(Bag& bag, int node) {
    for (int c = 0; c < 3; ++c) bag.held[3 * node + c] = 1;
}

int ring_start(int k) { return k == 0 ? 0 : 1 + 3 * k * (k - 1); }

/// Topology of hexagonal rings; counter-clockwise seen from +z.
void add_ring_faces(Surface& s, int n) {
    for (int k = 1; k <= n; ++k)
        for (int side = 0; side < 6; ++side)
            for (int j = 0; j < k; ++j) {
                const int o = ring_start(k) + side * k + j;
                const int o1 = ring_start(k) + (side * k + j + 1) % (6 * k);
                const int inner = 6 * (k - 1);
                const int i = k == 1 ? 0 : ring_start(k - 1) + (side * (k - 1) + j) % inner;
                s.faces.push_back({o, o1, i});
                if (j + 1 < k) {
                    const int i1 = ring_start(k - 1) + (side * (k - 1) + j + 1) % inner;
                    s.faces.push_back({i, o1, i1});
                }
            }
}

void flip(Surface& s) {
    for (auto& f : s.faces) std::swap(f[1], f[2]);
}

}  // namespace

Bag disk(double a, int n) {
    Bag bag;
    bag.surface.x.push_back(Vector3d::Zero());
    for (int k = 1; k <= n; ++k)
        for (int j = 0; j < 6 * k; ++j) {
            const double t = 2 * pi * j / (6 * k), r = a * k / n;
            bag.surface.x.push_back({r * std::cos(t), r * std::sin(t), 0});
        }
    add_ring_faces(bag.surface, n);
    flip(bag.surface);
    bag.held.assign(3 * bag.surface.x.size(), 0);
    for (int j = 0; j < 6 * n; ++j) hold(bag, ring_start(n) + j);
    return bag;
}

Bag sock(double a, double h, int n) {
    Bag bag = disk(a, n);
    for (auto& p : bag.surface.x) p[2] = -h;
    std::fill(bag.held.begin(), bag.held.end(), 0);
    const int m = 6 * n, rows = std::max(1, static_cast<int>(std::lround(h / (a / n))));
    int below = ring_start(n);
    for (int r = 1; r <= rows; ++r) {
        const int start = static_cast<int>(bag.surface.x.size());
        for (int j = 0; j < m; ++j) {
            const double t = 2 * pi * j / m;
            bag.surface.x.push_back({a * std::cos(t), a * std::sin(t), -h + h * r / rows});
        }
        for (int j = 0; j < m; ++j) {
            const int b0 = below + j, b1 = below + (j + 1) % m, t0 = start + j, t1 = start + (j + 1) % m;
            if ((r + j) % 2) {
                bag.surface.faces.push_back({b0, b1, t1});
                bag.surface.faces.push_back({b0, t1, t0});
            } else {
                bag.surface.faces.push_back({b0, b1, t0});
                bag.surface.faces.push_back({b1, t1, t0});
            }
        }
        below = start;
    }
    bag.held.assign(3 * bag.surface.x.size(), 0);
    for (int j = 0; j < m; ++j) hold(bag, below + j);
    return bag;
}

Bag hemisphere(double a, int n) {
    Bag bag = disk(1, n);
    for (auto& p : bag.surface.x) {
        const double r = std::min(1.0, std::hypot(p[0], p[1])), polar = 0.5 * pi * r;
        const double scale = r > 0 ? a * std::sin(polar) / r : 0;
        p = {p[0] * scale, p[1] * scale, -a * std::cos(polar)};
        if (r > 1 - 1e-12) p[2] = 0;
    }
    return bag;
}

Bag square(double w, int n) {
    Bag bag;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) bag.surface.x.push_back({w * j / n - w / 2, w * i / n - w / 2, 0});
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const int a = i * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
            if ((i + j) % 2) {
                bag.surface.faces.push_back({a, b, d});
                bag.surface.faces.push_back({a, d, c});
            } else {
                bag.surface.faces.push_back({a, b, c});
                bag.surface.faces.push_back({b, d, c});
            }
        }
    flip(bag.surface);
    bag.held.assign(3 * bag.surface.x.size(), 0);
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            if (i == 0 || j == 0 || i == n || j == n) hold(bag, i * (n + 1) + j);
    return bag;
}

Bag trough(double L, double width, int nx, int ny) {
    Bag bag;
    for (int i = 0; i <= ny; ++i)
        for (int j = 0; j <= nx; ++j) bag.surface.x.push_back({L * j / nx, width * i / ny, 0});
    for (int i = 0; i < ny; ++i)
        for (int j = 0; j < nx; ++j) {
            const int a = i * (nx + 1) + j, b = a + 1, c = a + nx + 1, d = c + 1;
            bag.surface.faces.push_back({a, d, b});
            bag.surface.faces.push_back({a, c, d});
        }
    bag.held.assign(3 * bag.surface.x.size(), 0);
    for (int i = 0; i <= ny; ++i)
        for (int j = 0; j <= nx; ++j) {
            bag.held[3 * (i * (nx + 1) + j) + 1] = 1;
            if (j == 0 || j == nx) hold(bag, i * (nx + 1) + j);
        }
    return bag;
}

void jiggle(std::vector<Vector3d>& x, const std::vector<char>& held, double amplitude, int seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
    for (std::size_t i = 0; i < x.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double d = uniform(random);
            if (held.empty() || !held[3 * i + c]) x[i][c] += d;
        }
}

arcsim::VectorXd flatten(const std::vector<Vector3d>& x) {
    arcsim::VectorXd v(3 * x.size());
    for (std::size_t i = 0; i < x.size(); ++i) v.segment<3>(3 * i) = x[i];
    return v;
}

}  // namespace shapes
