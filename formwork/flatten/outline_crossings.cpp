#include <algorithm>
#include <numeric>

#include "formwork/flatten/flatten.hpp"

namespace formwork {
namespace {

double orientation(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool meet(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
    const double abc = orientation(a, b, c), abd = orientation(a, b, d);
    const double cda = orientation(c, d, a), cdb = orientation(c, d, b);
    if (abc == 0 && abd == 0)   // on one line: the boxes decide
        return (a.cwiseMin(b).cwiseMax(c.cwiseMin(d)).array() <= a.cwiseMax(b).cwiseMin(c.cwiseMax(d)).array()).all();
    const auto same_side = [](double p, double q) { return (p > 0 && q > 0) || (p < 0 && q < 0); };
    return !same_side(abc, abd) && !same_side(cda, cdb);
}

}  // namespace

std::vector<std::pair<int, int>> outline_crossings(const std::vector<Vector2d>& outline, int limit) {
    std::vector<std::pair<int, int>> found;
    const int n = static_cast<int>(outline.size());
    const auto next = [&](int i) { return (i + 1) % n; };
    std::vector<double> left(n), right(n);
    for (int i = 0; i < n; ++i) {
        left[i] = std::min(outline[i].x(), outline[next(i)].x());
        right[i] = std::max(outline[i].x(), outline[next(i)].x());
    }
    std::vector<int> order(n), active;
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return left[a] < left[b]; });
    for (int i : order) {   // sweep along x: only edges whose x ranges meet are compared
        active.erase(std::remove_if(active.begin(), active.end(), [&](int j) { return right[j] < left[i]; }), active.end());
        for (int j : active) {
            if (j == next(i) || i == next(j)) continue;
            if (meet(outline[i], outline[next(i)], outline[j], outline[next(j)])) {
                found.emplace_back(std::min(i, j), std::max(i, j));
                if (static_cast<int>(found.size()) >= limit) return found;
            }
        }
        active.push_back(i);
    }
    return found;
}

}  // namespace formwork
