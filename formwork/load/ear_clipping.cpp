#include "formwork/load/ear_clipping.hpp"

#include <algorithm>

namespace formwork {

using arcsim::Triangle;
using arcsim::Vector2d;

namespace {

double cross(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double area(const std::vector<int>& loop, const std::vector<Vector2d>& p) {
    double sum = 0;
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) sum += cross(p[loop[0]], p[loop[i]], p[loop[i + 1]]);
    return 0.5 * sum;
}

bool inside(const Vector2d& q, const std::vector<int>& loop, const std::vector<Vector2d>& p) {
    bool in = false;
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
        const Vector2d &a = p[loop[i]], &b = p[loop[j]];
        if ((a[1] > q[1]) != (b[1] > q[1]) && q[0] < (b[0] - a[0]) * (q[1] - a[1]) / (b[1] - a[1]) + a[0]) in = !in;
    }
    return in;
}

/// Joins a hole to its outer loop between their nearest nodes.
void bridge(std::vector<int>& outer, const std::vector<int>& hole, const std::vector<Vector2d>& p) {
    std::size_t best_o = 0, best_h = 0;
    double best = 1e300;
    for (std::size_t o = 0; o < outer.size(); ++o)
        for (std::size_t h = 0; h < hole.size(); ++h)
            if (const double d = (p[outer[o]] - p[hole[h]]).squaredNorm(); d < best) best = d, best_o = o, best_h = h;
    std::vector<int> insert;
    for (std::size_t k = 0; k <= hole.size(); ++k) insert.push_back(hole[(best_h + k) % hole.size()]);
    insert.push_back(outer[best_o]);
    outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(best_o) + 1, insert.begin(), insert.end());
}

/// Cuts ears off, the best-shaped first among the next few; near-convex loops take linear time per ear.
void clip_ears(std::vector<int> loop, const std::vector<Vector2d>& p, std::vector<Triangle>& out) {
    while (loop.size() > 3) {
        const std::size_t n = loop.size();
        std::size_t ear = n;
        double best = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const int a = loop[(i + n - 1) % n], b = loop[i], c = loop[(i + 1) % n];
            const double A = cross(p[a], p[b], p[c]);
            if (A <= 0) continue;
            const double shape = A / ((p[b] - p[a]).squaredNorm() + (p[c] - p[b]).squaredNorm() + (p[a] - p[c]).squaredNorm());
            if (shape <= best) continue;
            bool empty = true;
            for (std::size_t k = 0; k < n && empty; ++k) {
                const int q = loop[k];
                if (q == a || q == b || q == c) continue;
                empty = !(cross(p[a], p[b], p[q]) >= 0 && cross(p[b], p[c], p[q]) >= 0 && cross(p[c], p[a], p[q]) >= 0);
            }
            if (empty) best = shape, ear = i;
        }
        if (ear == n) ear = 0;   // crossing or flat: the edges must match all the same
        out.push_back({loop[(ear + n - 1) % n], loop[ear], loop[(ear + 1) % n]});
        loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    if (loop.size() == 3) out.push_back({loop[0], loop[1], loop[2]});
}

}  // namespace

std::vector<Triangle> triangulate_loops(std::vector<std::vector<int>> loops, const std::vector<Vector2d>& p) {
    std::vector<std::vector<int>> outer, holes;
    for (auto& l : loops) (area(l, p) >= 0 ? outer : holes).push_back(std::move(l));
    for (auto& hole : holes) {
        std::vector<int>* around = nullptr;
        for (auto& o : outer)
            if (inside(p[hole[0]], o, p) && (!around || area(o, p) < area(*around, p))) around = &o;
        if (around)
            bridge(*around, hole, p);
        else
            outer.push_back(std::move(hole));
    }
    std::vector<Triangle> out;
    for (const auto& l : outer) clip_ears(l, p, out);
    return out;
}

}  // namespace formwork
