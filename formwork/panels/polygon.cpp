#include "formwork/panels/polygon.hpp"

#include <algorithm>
#include <clipper.hpp>
#include <cmath>
#include <limits>

namespace formwork {
namespace {

constexpr double units_per_mm = 1e4;   // Clipper works on integers

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

ClipperLib::Path to_clipper(const Polygon& p) {
    ClipperLib::Path path;
    for (const Vector2d& v : p)
        path.emplace_back(std::llround(v.x() * units_per_mm), std::llround(v.y() * units_per_mm));
    return path;
}

Polygon from_clipper(const ClipperLib::Path& path) {
    Polygon p;
    for (const ClipperLib::IntPoint& v : path)
        p.emplace_back(static_cast<double>(v.X) / units_per_mm, static_cast<double>(v.Y) / units_per_mm);
    return p;
}

}  // namespace

Box bounding_box(const Polygon& p) {
    const double inf = std::numeric_limits<double>::infinity();
    Box box{Vector2d(inf, inf), Vector2d(-inf, -inf)};
    for (const Vector2d& v : p) {
        box.low = box.low.cwiseMin(v);
        box.high = box.high.cwiseMax(v);
    }
    return box;
}

double signed_area(const Polygon& p) {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += cross(p[i], p[(i + 1) % p.size()]);
    return sum / 2;
}

double perimeter(const Polygon& p) {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += (p[(i + 1) % p.size()] - p[i]).norm();
    return sum;
}

bool contains(const Polygon& p, const Vector2d& point) {
    bool inside = false;
    for (std::size_t i = 0, j = p.size() - 1; i < p.size(); j = i++) {
        if ((p[i].y() > point.y()) == (p[j].y() > point.y())) continue;
        if (point.x() < p[i].x() + (p[j].x() - p[i].x()) * (point.y() - p[i].y()) / (p[j].y() - p[i].y())) inside = !inside;
    }
    return inside;
}

Vector2d nearest_on_outline(const Polygon& p, const Vector2d& point) {
    Vector2d nearest = p.front();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vector2d a = p[i], d = p[(i + 1) % p.size()] - a;
        const double length2 = d.squaredNorm(), t = length2 > 0 ? std::clamp((point - a).dot(d) / length2, 0.0, 1.0) : 0;
        const Vector2d q = a + t * d;
        if ((q - point).squaredNorm() < least) least = (q - point).squaredNorm(), nearest = q;
    }
    return nearest;
}

double distance_to_outline(const Polygon& p, const Vector2d& point) { return (nearest_on_outline(p, point) - point).norm(); }

std::optional<double> ray_to_outline(const Polygon& p, const Vector2d& origin, const Vector2d& direction, double from) {
    std::optional<double> nearest;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vector2d a = p[i], d = p[(i + 1) % p.size()] - a;
        const double det = cross(direction, d);
        if (std::abs(det) < 1e-12 * d.norm()) continue;
        const double t = cross(a - origin, d) / det, s = cross(a - origin, direction) / det;
        if (s >= -1e-9 && s <= 1 + 1e-9 && t >= from && (!nearest || t < *nearest)) nearest = t;
    }
    return nearest;
}

Room widest_room(const Polygon& p) {
    constexpr int cells = 24;   // across the longer side, refined twice around the best point
    const Box box = bounding_box(p);
    constexpr double enough = 45;      // mm: a label needs no more,
    constexpr double nearness = 0.02;  // and then stands near the middle
    const Vector2d middle = (box.low + box.high) / 2;
    Room best{middle, 0};
    double best_score = -std::numeric_limits<double>::infinity();
    Vector2d low = box.low, high = box.high;
    for (int level = 0; level < 3; ++level) {
        const double step = (high - low).maxCoeff() / cells;
        if (!(step > 0)) break;
        for (double y = low.y() + step / 2; y < high.y(); y += step)
            for (double x = low.x() + step / 2; x < high.x(); x += step) {
                const Vector2d at(x, y);
                if (!contains(p, at)) continue;
                const double radius = distance_to_outline(p, at);
                const double score = std::min(radius, enough) - nearness * (at - middle).norm();
                if (score > best_score) best = {at, radius}, best_score = score;
            }
        low = best.at - Vector2d(step, step);
        high = best.at + Vector2d(step, step);
    }
    return best;
}

std::vector<Polygon> difference(const std::vector<Polygon>& parts, const std::vector<Polygon>& holes) {
    ClipperLib::Clipper clipper;
    const auto add = [&](const std::vector<Polygon>& polygons, ClipperLib::PolyType type) {
        for (const Polygon& polygon : polygons) {
            ClipperLib::Path path = to_clipper(polygon);
            if (!ClipperLib::Orientation(path)) ClipperLib::ReversePath(path);
            clipper.AddPath(path, type, true);
        }
    };
    add(parts, ClipperLib::ptSubject);
    add(holes, ClipperLib::ptClip);
    ClipperLib::Paths result;
    clipper.Execute(ClipperLib::ctDifference, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    std::vector<Polygon> outlines;
    for (const ClipperLib::Path& path : result)
        if (ClipperLib::Orientation(path)) outlines.push_back(from_clipper(path));
    return outlines;
}

Polygon outer_union(const std::vector<Polygon>& parts) {
    Polygon outer;
    for (Polygon& candidate : difference(parts, {}))
        if (signed_area(candidate) > signed_area(outer)) outer = std::move(candidate);
    return outer;
}

Polygon inflated(const Polygon& p, double distance) {
    constexpr double arc_tolerance = 0.05;   // mm
    ClipperLib::ClipperOffset offset(2, arc_tolerance * units_per_mm);
    ClipperLib::Path path = to_clipper(p);
    if (!ClipperLib::Orientation(path)) ClipperLib::ReversePath(path);
    offset.AddPath(path, ClipperLib::jtRound, ClipperLib::etClosedPolygon);
    ClipperLib::Paths result;
    offset.Execute(result, (distance + arc_tolerance) * units_per_mm);
    Polygon outer;
    for (const ClipperLib::Path& candidate : result) {
        Polygon q = from_clipper(candidate);
        if (signed_area(q) > signed_area(outer)) outer = std::move(q);
    }
    return outer;
}

double overlap_area(const Polygon& a, const Polygon& b) {
    ClipperLib::Clipper clipper;
    clipper.AddPath(to_clipper(a), ClipperLib::ptSubject, true);
    clipper.AddPath(to_clipper(b), ClipperLib::ptClip, true);
    ClipperLib::Paths result;
    clipper.Execute(ClipperLib::ctIntersection, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    double sum = 0;
    for (const ClipperLib::Path& path : result) sum += std::abs(signed_area(from_clipper(path)));
    return sum;
}

}  // namespace formwork
