#include <algorithm>
#include <cmath>
#include <numbers>

#include "arcsim/base/error.hpp"
#include "formwork/mesher/mesh_kinds.hpp"
#include "formwork/mesher/ring_mesh.hpp"

namespace formwork {

using arcsim::InputError;
using arcsim::Vector2d;
using std::numbers::pi;

namespace {

/// The curve |x|^p + |y/aspect|^p = 1, by length.
class Superellipse {
public:
    Superellipse(double exponent, double aspect) {
        for (int i = 0; i <= n; ++i) {
            const double a = 2 * pi * i / n, c = std::cos(a), s = std::sin(a);
            point_[i] = {std::copysign(std::pow(std::abs(c), 2 / exponent), c),
                         aspect * std::copysign(std::pow(std::abs(s), 2 / exponent), s)};
            length_[i] = i == 0 ? 0 : length_[i - 1] + (point_[i] - point_[i - 1]).norm();
        }
    }
    Vector2d operator()(double t) const {
        t -= std::floor(t);
        const double target = t * length_[n];
        const int i = std::clamp(static_cast<int>(std::lower_bound(length_.begin(), length_.end(), target) - length_.begin()), 1, n);
        const double f = (target - length_[i - 1]) / (length_[i] - length_[i - 1]);
        return point_[i - 1] + f * (point_[i] - point_[i - 1]);
    }

private:
    static constexpr int n = 14400;   // fine enough that its own polygon does not show
    std::vector<Vector2d> point_{static_cast<std::size_t>(n + 1)};
    std::vector<double> length_ = std::vector<double>(n + 1);
};

/// A bag whose section at every height is one shape, scaled and turned; the profile is (radius, height).
class Bag : public SweptSection {
public:
    Bag(double exponent, double aspect, double twist) : shape_(exponent, aspect), twist_(twist) {}

    /// Appends points of the profile; `corner` marks a point that must carry a ring.
    void add(double r, double z, bool corner) {
        if (!profile_.empty()) {
            const double step = (Vector2d(r, z) - profile_.back()).norm();
            s_.push_back(s_.back() + step);
        } else {
            s_.push_back(0);
        }
        profile_.push_back({r, z});
        if (corner) corners_.push_back(s_.back());
        top_ = std::max(top_, z);
    }
    Vector3d point(double s, double t) const override {
        const double target = s * s_.back();
        const int i = std::clamp(static_cast<int>(std::lower_bound(s_.begin(), s_.end(), target) - s_.begin()), 1,
                                 static_cast<int>(s_.size()) - 1);
        const double f = (target - s_[i - 1]) / (s_[i] - s_[i - 1]);
        const Vector2d rz = profile_[i - 1] + f * (profile_[i] - profile_[i - 1]);
        const double turn = twist_ * rz[1] / top_;
        return Eigen::AngleAxisd(turn, Vector3d::UnitZ()) * Vector3d(rz[0] * shape_(t)[0], rz[0] * shape_(t)[1], rz[1]);
    }
    std::vector<double> breaks() const override {
        std::vector<double> b;
        for (const double s : corners_) b.push_back(s / s_.back());
        return b;
    }

private:
    Superellipse shape_;
    double twist_;
    double top_ = 0;
    std::vector<Vector2d> profile_;
    std::vector<double> s_, corners_;
};

/// Rounds a profile's corner between a flat bottom of radius r and a wall: quarter circle of radius `fillet`.
void add_rounded_bottom(Bag& bag, double r, double fillet) {
    bag.add(0, 0, true);
    constexpr int steps = 16;
    for (int i = 0; i <= steps; ++i) {
        const double a = pi / 2 * i / steps;
        bag.add(r - fillet + fillet * std::sin(a), fillet - fillet * std::cos(a), false);
    }
}

void require(bool ok, const char* message) {
    if (!ok) throw InputError(message);
}

/// Monotone through its points and smooth: cubic Hermite with the slopes limited (Fritsch and Carlson).
double interpolate(const std::vector<Vector2d>& p, double z) {
    const int n = static_cast<int>(p.size());
    std::vector<double> d(n - 1), m(n);
    for (int i = 0; i + 1 < n; ++i) d[i] = (p[i + 1][1] - p[i][1]) / (p[i + 1][0] - p[i][0]);
    m[0] = d[0], m[n - 1] = d[n - 2];
    for (int i = 1; i + 1 < n; ++i) m[i] = d[i - 1] * d[i] <= 0 ? 0 : 2 * d[i - 1] * d[i] / (d[i - 1] + d[i]);
    int i = 0;
    while (i + 2 < n && z > p[i + 1][0]) ++i;
    const double h = p[i + 1][0] - p[i][0], t = (z - p[i][0]) / h;
    return (1 + 2 * t) * (1 - t) * (1 - t) * p[i][1] + t * (1 - t) * (1 - t) * h * m[i] +
           t * t * (3 - 2 * t) * p[i + 1][1] + t * t * (t - 1) * h * m[i + 1];
}

}  // namespace

Surface make_sock(const SockSize& size) {
    require(size.edge < size.radius, "formwork mesh sock: --edge must be smaller than --radius.");
    Bag bag(2, 1, 0);
    bag.add(0, 0, true);
    bag.add(size.radius, 0, true);
    bag.add(size.radius, size.height, true);
    return mesh_swept_section(bag, size.edge);
}

Surface make_sphere(const SphereSize& size) {
    require(size.edge < size.radius, "formwork mesh sphere: --edge must be smaller than --radius.");
    require(size.opening < size.radius, "formwork mesh sphere: --opening must be smaller than --radius.");
    Bag bag(2, 1, 0);
    const double end = size.opening > 0 ? pi - std::asin(size.opening / size.radius) : pi;
    constexpr int steps = 2000;
    for (int i = 0; i <= steps; ++i) {
        const double a = end * i / steps;
        const double r = i == 0 || (i == steps && size.opening == 0) ? 0 : size.radius * std::sin(a);
        bag.add(r, size.radius * (1 - std::cos(a)), i == 0 || i == steps);
    }
    return mesh_swept_section(bag, size.edge);
}

Surface make_column(const ColumnSize& size) {
    require(size.edge < size.bottom_radius, "formwork mesh column: --edge must be smaller than --bottom-radius.");
    require(size.fillet < size.bottom_radius && size.fillet < size.height,
            "formwork mesh column: --fillet must be smaller than --bottom-radius and --height.");
    Bag bag(size.exponent, size.aspect, size.twist_deg * pi / 180);
    add_rounded_bottom(bag, size.bottom_radius, size.fillet);
    constexpr int steps = 200;
    for (int i = 1; i <= steps; ++i) {
        const double f = static_cast<double>(i) / steps;
        bag.add(size.bottom_radius + f * (size.top_radius - size.bottom_radius),
                size.fillet + f * (size.height - size.fillet), i == steps);
    }
    return mesh_swept_section(bag, size.edge);
}

Surface make_vase(const VaseSize& size) {
    require(size.edge < size.foot_radius && size.edge < size.neck_radius,
            "formwork mesh vase: --edge must be smaller than --foot-radius and --neck-radius.");
    require(0 < size.belly_height && size.belly_height < size.neck_height && size.neck_height < 1,
            "formwork mesh vase: give 0 < --belly-height < --neck-height < 1 (fractions of the height).");
    Bag bag(2, 1, 0);
    const double fillet = 0.3 * size.foot_radius;
    add_rounded_bottom(bag, size.foot_radius, fillet);
    const std::vector<Vector2d> outline{{fillet, size.foot_radius},
                                        {size.belly_height * size.height, size.belly_radius},
                                        {size.neck_height * size.height, size.neck_radius},
                                        {size.height, size.lip_radius}};
    constexpr int steps = 400;
    for (int i = 1; i <= steps; ++i) {
        const double z = fillet + (size.height - fillet) * i / steps;
        bag.add(interpolate(outline, z), z, i == steps);
    }
    return mesh_swept_section(bag, size.edge);
}

}  // namespace formwork
