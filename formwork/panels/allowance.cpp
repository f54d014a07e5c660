#include "formwork/panels/allowance.hpp"

#include <cmath>

namespace formwork {
namespace {

constexpr double seat = 0.02;       // mm that a strip reaches into the piece: a shared edge alone is not always merged
constexpr double straight = 1e-6;   // sine of a turn below which two edges have one normal

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
Vector2d outward(const Vector2d& from, const Vector2d& to) {
    const Vector2d d = (to - from).normalized();
    return {d.y(), -d.x()};
}

}  // namespace

Polygon cut_line(const Polygon& sew, const std::vector<double>& allowance, Corner corner, double mitre_limit) {
    const std::size_t n = sew.size();
    std::vector<Polygon> parts{sew};
    for (std::size_t i = 0; i < n; ++i) {
        const Vector2d &a = sew[(i + n - 1) % n], &p = sew[i], &b = sew[(i + 1) % n];
        const double before = allowance[(i + n - 1) % n], after = allowance[i];
        const Vector2d n1 = outward(a, p), n2 = outward(p, b);
        if (after > 0) parts.push_back({p - seat * n2, p + after * n2, b + after * n2, b - seat * n2});
        const double turn = cross(n1, n2);
        const bool reversal = n1.dot(n2) < 0;   // the tip of a slit: no normal in between to fill
        if ((turn <= straight && !reversal) || (before <= 0 && after <= 0)) continue;
        // Its feet stand in the strips on either side.
        const Vector2d back(n1.y(), -n1.x()), ahead(-n2.y(), n2.x());
        Polygon wedge{p - seat * (n1 + n2), p + before * n1 + seat * back, p + before * n1, p + after * n2, p + after * n2 + seat * ahead};
        if (turn > straight) {   // a convex corner: the point where both offset lines meet
            const Vector2d m = (before * Vector2d(n2.y(), -n2.x()) - after * Vector2d(n1.y(), -n1.x())) / turn;
            const bool small_turn = n1.dot(n2) > 0.9 && std::abs(before - after) < 1e-9;   // along a smooth curve
            const bool ahead_of_both = m.dot(back) <= 0 && m.dot(ahead) <= 0;   // else the wider strip ends in a step
            const bool mitred = corner == Corner::mitre && m.norm() <= mitre_limit * std::max(before, after);
            if (ahead_of_both && (mitred || small_turn)) wedge.insert(wedge.begin() + 3, p + m);
        }
        if (std::abs(signed_area(wedge)) > 0) parts.push_back(wedge);
    }
    return outer_union(parts);
}

}  // namespace formwork
