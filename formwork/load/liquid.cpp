#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "formwork/load/pressure_force.hpp"

namespace formwork {

int liquid_orientation(const std::vector<Triangle>& faces, const VectorXd& x, const Vector3d& up, double level) {
    PressureForce probe(faces, up, 1, 0, PressureQuadrature::consistent, PressureJacobian::none);
    const LiquidTotals wet = std::isfinite(level) ? probe.totals(x, level) : LiquidTotals{};
    double area = 0, downward = 0, enclosed = 0, size = 0;
    const Vector3d origin = faces.empty() ? Vector3d::Zero() : Vector3d(x.segment<3>(3 * faces[0][0]));
    for (const Triangle& t : faces) {
        const Vector3d a = x.segment<3>(3 * t[0]) - origin, b = x.segment<3>(3 * t[1]) - origin,
                       c = x.segment<3>(3 * t[2]) - origin;
        const Vector3d N = 0.5 * (b - a).cross(c - a);
        area += N.norm();
        downward -= N.dot(up);
        enclosed += N.dot(a + b + c) / 9;
        size = std::max({size, a.norm(), b.norm(), c.norm()});
    }
    constexpr double noise = 1e-6;   // of area times size: below it the sign is rounding
    if (std::abs(wet.volume) > noise * area * size) return wet.volume > 0 ? 1 : -1;
    if (std::abs(downward) > noise * area) return downward > 0 ? 1 : -1;
    if (std::abs(enclosed) > noise * area * size) return enclosed > 0 ? 1 : -1;
    return 1;
}

double level_of_volume(const PressureForce& load, const VectorXd& x, double volume, double start) {
    double low = 1e300, high = -1e300;
    for (int i = 0; i < x.size() / 3; ++i) {
        const double z = x.segment<3>(3 * i).dot(load.up());
        low = std::min(low, z);
        high = std::max(high, z);
    }
    const double size = std::max(high - low, std::cbrt(volume));
    // The level can stand above the highest node (a head over the rim), where the volume grows linearly.
    double top = high;
    LiquidTotals at_top = load.totals(x, top);
    if (at_top.volume < volume) {
        if (at_top.waterplane <= 1e-9 * size * size) return std::numeric_limits<double>::infinity();
        return top + (volume - at_top.volume) / at_top.waterplane;
    }
    double bottom = low, h = std::clamp(start, bottom, top);
    for (int i = 0; i < 100; ++i) {   // Newton inside a bracket: the volume grows with the level
        const LiquidTotals t = load.totals(x, h);
        const double error = t.volume - volume;
        (error > 0 ? top : bottom) = h;
        if (std::abs(error) <= 1e-15 * volume || top - bottom < 1e-16 * size) break;
        double next = t.waterplane > 0 ? h - error / t.waterplane : 0.5 * (bottom + top);
        if (!(next > bottom && next < top)) next = 0.5 * (bottom + top);
        if (next == h) break;
        h = next;
    }
    return h;
}

}  // namespace formwork
