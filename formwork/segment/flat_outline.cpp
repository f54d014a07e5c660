#include "formwork/segment/flat_outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace formwork {
namespace {

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {   // twice the area, positive to the left
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

}  // namespace

double solidity(const std::vector<Vector2d>& outline) {
    std::vector<Vector2d> points = outline;
    double area = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) area += turn(Vector2d::Zero(), outline[i], outline[(i + 1) % outline.size()]);
    std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
        return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
    });
    double hull = 0;   // twice its area, like the other; Andrew's monotone chains
    for (int half = 0; half < 2; ++half) {
        std::vector<Vector2d> chain;
        for (const Vector2d& p : points) {
            while (chain.size() > 1 && turn(chain[chain.size() - 2], chain.back(), p) <= 0) chain.pop_back();
            chain.push_back(p);
        }
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) hull += turn(Vector2d::Zero(), chain[i], chain[i + 1]);
        std::reverse(points.begin(), points.end());
    }
    return hull > 0 ? std::abs(area) / hull : 1;
}

OutlineGaps outline_gaps(const std::vector<Vector2d>& outline, double reach) {
    const int n = static_cast<int>(outline.size());
    const auto at = [&](int i) -> const Vector2d& { return outline[i % n]; };
    std::vector<double> place(n + 1, 0);
    double area = 0;
    for (int i = 0; i < n; ++i) {
        place[i + 1] = place[i] + (at(i + 1) - at(i)).norm();
        area += turn(Vector2d::Zero(), at(i), at(i + 1));
    }
    const double side = area < 0 ? -1 : 1;   // of the inside
    OutlineGaps gaps{std::numeric_limits<double>::infinity(), 1};
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vector2d &p = at(i), &a = at(j), &b = at(j + 1);
            const bool is_inside = side * turn(a, b, p) > 0;   // seen from this side
            const double t = std::clamp((p - a).dot(b - a) / std::max((b - a).squaredNorm(), 1e-300), 0., 1.);
            const double distance = (p - a - t * (b - a)).norm();
            if (distance >= (is_inside ? 2 * reach * gaps.neck : gaps.inlet)) continue;
            const double way = std::abs(place[j] + t * (place[j + 1] - place[j]) - place[i]), apart = std::min(way, place[n] - way);
            if (is_inside && apart > 0.5 * reach) gaps.neck = std::min(gaps.neck, distance / std::min(apart, 2 * reach));
            if (!is_inside && apart > reach) gaps.inlet = distance;
        }
    return gaps;
}

}  // namespace formwork
