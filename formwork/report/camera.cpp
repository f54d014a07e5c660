#include "formwork/report/camera.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace formwork {

void horizontal_axes(const Vector3d& up, Vector3d& first, Vector3d& second) {
    const Vector3d d = up.normalized();
    const Vector3d seed = std::abs(d.x()) < 0.9 ? Vector3d::UnitX() : Vector3d::UnitY();
    first = (seed - seed.dot(d) * d).normalized();
    second = d.cross(first);
}

Camera::Camera(const std::vector<Vector3d>& points, const Vector3d& up, double azimuth_deg,
               double elevation_deg) {
    Vector3d lo = Vector3d::Constant(1e300), hi = Vector3d::Constant(-1e300);
    for (const Vector3d& p : points) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
    if (points.empty()) lo = Vector3d::Zero(), hi = Vector3d::Ones();
    centre_ = (lo + hi) / 2;
    radius_ = std::max((hi - lo).norm() / 2, 1e-12);
    distance_ = 7 * radius_;  // a long lens: little foreshortening, so that lengths can be compared

    Vector3d e1, e2;
    horizontal_axes(up, e1, e2);
    const double a = azimuth_deg * M_PI / 180, h = elevation_deg * M_PI / 180;
    back_ = (std::cos(h) * (std::cos(a) * e1 + std::sin(a) * e2) + std::sin(h) * up.normalized())
                .normalized();
    right_ = up.normalized().cross(back_);
    if (right_.norm() < 1e-6) right_ = e2;  // straight from above
    right_.normalize();
    up_ = back_.cross(right_);
}

double Camera::fit(const std::vector<Vector3d>& points, double x0, double y0, double x1,
                   double y1) {
    scale_ = 1, shift_x_ = shift_y_ = 0;
    if (points.empty()) return scale_;
    double lo_y = 1e300, hi_y = -1e300;
    lo_x_ = 1e300, hi_x_ = -1e300;
    for (const Vector3d& p : points) {
        const Projected q = project(p);
        lo_x_ = std::min(lo_x_, q.x), hi_x_ = std::max(hi_x_, q.x);
        lo_y = std::min(lo_y, q.y), hi_y = std::max(hi_y, q.y);
    }
    scale_ = std::min((x1 - x0) / std::max(hi_x_ - lo_x_, 1e-12),
                      (y1 - y0) / std::max(hi_y - lo_y, 1e-12));
    shift_x_ = (x0 + x1) / 2 - scale_ * (lo_x_ + hi_x_) / 2;
    middle_y_ = (y0 + y1) / 2;
    shift_y_ = middle_y_ - scale_ * (lo_y + hi_y) / 2;
    return scale_;
}

double Camera::rescale(double px_per_unit, double x0) {
    shift_y_ = middle_y_ + px_per_unit / scale_ * (shift_y_ - middle_y_);
    scale_ = px_per_unit;
    shift_x_ = x0 - scale_ * lo_x_;
    return scale_ * (hi_x_ - lo_x_);
}

Projected Camera::project(const Vector3d& p) const {
    const Vector3d d = p - centre_;
    const double nearness = 1 / (distance_ - d.dot(back_));
    const double magnify = distance_ * nearness;
    return {shift_x_ + scale_ * magnify * d.dot(right_), shift_y_ - scale_ * magnify * d.dot(up_),
            nearness};
}

double Camera::nearness_step(double nearness, double metres) const {
    return 1 / (1 / nearness - metres);
}
Vector3d Camera::to_view(const Vector3d& d) const {
    return {d.dot(right_), d.dot(up_), d.dot(back_)};
}
Vector3d Camera::towards_eye(const Vector3d& from) const {
    return (centre_ + distance_ * back_ - from).normalized();
}

}  // namespace formwork
