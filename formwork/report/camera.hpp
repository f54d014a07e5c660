#pragma once

#include <vector>

#include "arcsim/base/types.hpp"

namespace formwork {

using arcsim::Vector3d;

/// A point as the picture sees it: px from the top left, and nearness (larger is nearer), which is
/// linear across the projection of a plane so that it can be interpolated over triangles.
struct Projected {
    double x = 0, y = 0, nearness = 0;
};

/// A mild perspective from a distance of a few diameters, fitted to a box of the picture.
class Camera {
public:
    /// @param points     what must be in view, m
    /// @param up         the picture's upward direction
    /// @param azimuth    degrees about `up`; 0 looks along -e where e is the first horizontal axis
    /// @param elevation  degrees above the horizon
    Camera(const std::vector<Vector3d>& points, const Vector3d& up, double azimuth_deg,
           double elevation_deg);

    /// Scales and centres the picture so that the points fill the box (px). Returns the scale.
    double fit(const std::vector<Vector3d>& points, double x0, double y0, double x1, double y1);
    /// Another scale about the same middle height, with the picture's left end at x0. Returns the
    /// width, px.
    double rescale(double px_per_unit, double x0);

    Projected project(const Vector3d& p) const;
    double nearness_step(double nearness,
                         double metres) const;          // nearness after a move towards the eye
    Vector3d to_view(const Vector3d& direction) const;  // right, up, towards the eye
    Vector3d towards_eye(const Vector3d& from) const;   // unit vector from a point to the eye
    double diameter() const { return 2 * radius_; }
    double scale() const { return scale_; }   // px per metre at the middle of the shape

private:
    Vector3d centre_, right_, up_, back_;
    double radius_ = 1, distance_ = 4;
    double scale_ = 1, shift_x_ = 0, shift_y_ = 0, lo_x_ = 0, hi_x_ = 0, middle_y_ = 0;
};

/// Two horizontal unit axes for a given up direction; the first is x when up is not x.
void horizontal_axes(const Vector3d& up, Vector3d& first, Vector3d& second);

}  // namespace formwork
