#include "formwork/panels/allowance.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace formwork {
namespace {

constexpr double seat = 0.02;       // mm that a strip reaches into the piece: a shared edge alone is not always merged
constexpr double straight = 1e-6;   // sine of a turn below which two edges have one normal

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
Vector2d outward(const Vector2d& from, const Vector2d& to) {
    const Vector2d d = (to - from).normalized();
    return {d.y(), -d.x()};
}

/// The cloth along edge p -> b.
Polygon strip(const Vector2d& p, const Vector2d& b, double width) {
    const Vector2d n = outward(p, b);
    return {p - seat * n, p + width * n, b + width * n, b - seat * n};
}

/// What lies between the strips before and after corner p; empty where they leave nothing to fill.
Polygon wedge(const Vector2d& a, const Vector2d& p, const Vector2d& b, double before, double after, Corner corner, double mitre_limit) {
    const Vector2d n1 = outward(a, p), n2 = outward(p, b);
    const double turn = cross(n1, n2);
    const bool reversal = n1.dot(n2) < 0;   // the tip of a slit: no normal in between to fill
    if ((turn <= straight && !reversal) || (before <= 0 && after <= 0)) return {};
    // Its feet stand in the strips on either side.
    const Vector2d back(n1.y(), -n1.x()), ahead(-n2.y(), n2.x());
    Polygon w{p - seat * (n1 + n2), p + before * n1 + seat * back, p + before * n1, p + after * n2, p + after * n2 + seat * ahead};
    if (turn > straight) {   // a convex corner: the point where both offset lines meet
        const Vector2d m = (before * Vector2d(n2.y(), -n2.x()) - after * Vector2d(n1.y(), -n1.x())) / turn;
        const bool small_turn = n1.dot(n2) > 0.9 && std::abs(before - after) < 1e-9;   // along a smooth curve
        const bool ahead_of_both = m.dot(back) <= 0 && m.dot(ahead) <= 0;   // else the wider strip ends in a step
        const bool mitred = corner == Corner::mitre && m.norm() <= mitre_limit * std::max(before, after);
        if (ahead_of_both && (mitred || small_turn)) w.insert(w.begin() + 3, p + m);
    }
    return std::abs(signed_area(w)) > 0 ? w : Polygon{};
}

/// A hem's end at corner p. Coordinates (s, h): s along the fold, away from the seam, h outwards.
struct HemEnd {
    Vector2d p, along, out;
    double foot, head;   // s where the mirrored line leaves the fold, and where it reaches the hem's width
    double width;
    Vector2d at(double s, double h) const { return p + s * along + h * out; }

    /// Cloth up to the mirrored line, seated in the first strip.
    Polygon added() const {
        return {at(foot, -seat), at(foot, 0), at(head, width), at(std::max(head, 0.0) + seat, width), at(std::max(foot, 0.0) + seat, -seat)};
    }
    /// Cloth beyond it.
    Polygon removed() const {
        const double far = 4 * width + std::abs(foot) + std::abs(head), slope = (head - foot) / width;
        return {at(foot, 0), at(foot + 2 * slope * width, 2 * width), at(-far, 2 * width), at(-far, 0)};
    }
};

/// The end of a hem where it meets the seam edge from p to `seam_to`, if the seam crosses the fold steeply enough to be mirrored.
std::optional<HemEnd> hem_end(const Vector2d& p, const Vector2d& fold_to, const Vector2d& seam_to, const Vector2d& out,
                            const Vector2d& seam_out, double seam_allowance, double width) {
    constexpr double steepest = 0.35;   // sine of 20°: flatter, the end would be as long as the hem is wide
    const Vector2d along = (fold_to - p).normalized(), seam = (seam_to - p).normalized();
    const double down = -seam.dot(out);
    if (down < steepest || width <= 0) return {};
    const double foot = seam_allowance * (seam_out.dot(along) + seam_out.dot(out) * seam.dot(along) / down);
    return HemEnd{p, along, out, foot, foot + width * seam.dot(along) / down, width};
}

}  // namespace

Polygon cut_line(const Polygon& sew, const std::vector<double>& allowance, Corner corner, double mitre_limit,
                 const std::vector<char>& folded) {
    const std::size_t n = sew.size();
    const auto is_fold = [&](std::size_t edge) { return !folded.empty() && folded[edge % n] != 0; };
    std::size_t start = 0;   // where a hem begins, so that none is met in two halves
    while (start < n && (!is_fold(start) || is_fold(start + n - 1))) ++start;

    struct Hem {
        std::vector<Polygon> cloth, beyond;   // its ends remove nothing of another hem
    };
    // Where the seam is a hem's width away from its end at p, or its next corner: near their ends flat seams are often
    // rounded, and what the folded hem must lie on is the seam as far as it reaches.
    const auto along_seam = [&](std::size_t p, bool forwards, double width) {
        constexpr double corner_cosine = 0.87;   // 30°
        Vector2d before = Vector2d::Zero();
        double reached = 0;
        for (std::size_t i = p, k = 0; k < n; ++k) {
            const std::size_t edge = forwards ? i : (i + n - 1) % n, next = forwards ? (i + 1) % n : edge;
            const Vector2d step = sew[next] - sew[i];
            const double length = step.norm();
            if (is_fold(edge) || step.dot(before) < corner_cosine * length * before.norm()) return sew[i];
            if (reached + length >= width) return Vector2d(sew[i] + (width - reached) / length * step);
            reached += length;
            before = step;
            i = next;
        }
        return sew[p];
    };
    std::vector<Polygon> parts{sew};
    std::vector<Hem> hems(1);
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = (start + k) % n, last = (i + n - 1) % n;
        const Vector2d &a = sew[last], &p = sew[i], &b = sew[(i + 1) % n];
        const bool begins = is_fold(i) && !is_fold(last), ends = !is_fold(i) && is_fold(last);
        if (begins) hems.emplace_back();
        Hem& hem = hems.back();
        if (allowance[i] > 0) (is_fold(i) ? hem.cloth : parts).push_back(strip(p, b, allowance[i]));
        std::optional<HemEnd> end;
        Vector2d seam_out(0, 0);
        if (begins) {
            const Vector2d from = along_seam(i, false, allowance[i]);
            seam_out = outward(from, p);
            end = hem_end(p, b, from, outward(p, b), seam_out, allowance[last], allowance[i]);
        } else if (ends) {
            const Vector2d to = along_seam(i, true, allowance[last]);
            seam_out = outward(p, to);
            end = hem_end(p, a, to, outward(a, p), seam_out, allowance[i], allowance[last]);
        }
        if (!end) {
            Polygon w = wedge(a, p, b, allowance[last], allowance[i], corner, mitre_limit);
            if (!w.empty()) (is_fold(i) && is_fold(last) ? hem.cloth : parts).push_back(std::move(w));
            continue;
        }
        hem.cloth.push_back(end->added());
        hem.beyond.push_back(end->removed());
        // The seam's own allowance runs on to the fold: from the strip's end, seated in it, and from the mean direction's.
        const double width = allowance[begins ? last : i];
        const Vector2d strip_out = begins ? outward(a, p) : outward(p, b), back = seat * ((begins ? a : b) - p).normalized();
        const Vector2d foot = end->at(end->foot, 0);
        parts.push_back({p + back - seat * strip_out, p + back + width * strip_out, p + width * strip_out, foot});
        parts.push_back({p - seat * seam_out, p + width * seam_out, foot});
    }
    for (const Hem& hem : hems)
        for (Polygon& part : difference(hem.cloth, hem.beyond)) parts.push_back(std::move(part));
    return outer_union(parts);
}

}  // namespace formwork
