#pragma once

#include <optional>
#include <vector>

#include "arcsim/base/types.hpp"

namespace formwork {

using arcsim::Vector2d;

/// Plane polygons in millimetres, closed without repeating the first point.
using Polygon = std::vector<Vector2d>;

struct Box {
    Vector2d low, high;
    Vector2d size() const { return high - low; }
};
Box bounding_box(const Polygon& p);
double signed_area(const Polygon& p);   // > 0: counter-clockwise
double perimeter(const Polygon& p);
bool contains(const Polygon& p, const Vector2d& point);
Vector2d nearest_on_outline(const Polygon& p, const Vector2d& point);
double distance_to_outline(const Polygon& p, const Vector2d& point);

/// How far the ray from `origin` along the unit vector `direction` runs until it meets the outline; hits
/// nearer than `from` do not count.
std::optional<double> ray_to_outline(const Polygon& p, const Vector2d& origin, const Vector2d& direction, double from = 0);

/// A point inside the polygon far from the outline, and near the middle where there is room enough: for a label.
struct Room {
    Vector2d at{0, 0};
    double radius = 0;
};
Room widest_room(const Polygon& p);

/// The outer outline of the union of polygons, counter-clockwise and free of crossings; empty without area.
/// Points are rounded to 0.1 µm.
Polygon outer_union(const std::vector<Polygon>& parts);

/// The outer outlines of the union of `parts` less that of `holes`.
std::vector<Polygon> difference(const std::vector<Polygon>& parts, const std::vector<Polygon>& holes);

/// All points nearer than `distance` to the polygon; round corners.
Polygon inflated(const Polygon& p, double distance);

double overlap_area(const Polygon& a, const Polygon& b);   // mm²

}  // namespace formwork
