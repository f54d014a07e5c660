#include "axisymmetric_bag.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>

namespace axisymmetric {
namespace {

using formwork::MaterialParams;
using Unknowns = Eigen::Vector2d;

/// Nominal tension along `l1`, N per rest metre: l1 S1, S1 = k e1 + q e2, stiffness at the larger stretch.
double tension(const MaterialParams& m, double l1, double l2) {
    const double t = std::clamp((std::max(l1, l2) - 1) / (m.max_stretch - 1), 0.0, 1.0);
    const double k = m.rest[0] + t * (m.max[0] - m.rest[0]), q = m.rest[1] + t * (m.max[1] - m.rest[1]);
    return l1 * 0.5 * (k * (l1 * l1 - 1) + q * (l2 * l2 - 1));
}

/// The stretch at which the tension is N beside a crosswise stretch l2, by false position (Illinois); tension grows with
/// stretch above the fold at 0.6.
double stretch_at(const MaterialParams& m, double N, double l2) {
    double low = 0.6, high = 10, f_low = tension(m, low, l2) - N, f_high = tension(m, high, l2) - N, l = low;
    if (!(f_low < 0 && f_high > 0)) return std::nan("");
    int side = 0;
    for (int i = 0; i < 100 && high - low > 1e-14; ++i) {
        const double before = l;
        l = (low * f_high - high * f_low) / (f_high - f_low);
        const double f = tension(m, l, l2) - N;
        if (f == 0 || std::abs(l - before) < 1e-15) break;
        if (f < 0) {
            low = l, f_low = f;
            if (side < 0) f_high *= 0.5;
            side = -1;
        } else {
            high = l, f_high = f;
            if (side > 0) f_low *= 0.5;
            side = 1;
        }
    }
    return l;
}

/// Newton with differences on two equations.
bool shoot(Unknowns& u, const std::function<Unknowns(const Unknowns&)>& miss) {
    Unknowns f = miss(u);
    for (int step = 0; step < 60; ++step) {
        if (f.norm() < 1e-11) return true;
        Eigen::Matrix2d J;
        for (int k = 0; k < 2; ++k) {
            const double h = 1e-7;
            Unknowns v = u;
            v[k] += h;
            J.col(k) = (miss(v) - f) / h;
        }
        const Unknowns d = -J.fullPivLu().solve(f);
        double a = 1;
        for (;; a *= 0.5) {
            const Unknowns there = miss(u + a * d);
            if (there.allFinite() && there.norm() < f.norm()) {
                u += a * d, f = there;
                break;
            }
            if (a < 1e-6) return f.norm() < 1e-9;
        }
    }
    return false;
}

/// r, height y above the rim, angle phi of the meridian, R N1, volume, vertical force.
using State = Eigen::Matrix<double, 6, 1>;

/// Along the rest meridian s from the pole, R(s) its rest radius:
///   r' = l1 cos phi, y' = l1 sin phi, (R N1)' = N2 cos phi, R N1 phi' = p r l1 - N2 sin phi
class Meridian {
public:
    explicit Meridian(const Bag& bag) : b_(bag) {
        length_ = b_.kind == "sock" ? b_.radius + b_.height : b_.kind == "hemisphere" ? 0.5 * M_PI * b_.radius : b_.radius;
    }

    State end(double pole_stretch, double pole_height) {
        constexpr int steps = 1000;
        const double h = length_ / steps;
        least_ = 1e300;
        const double N = tension(b_.fabric, pole_stretch, pole_stretch);
        const double turn = pressure(pole_height) * pole_stretch * pole_stretch / (2 * N);   // phi' at the pole
        State x;
        x << pole_stretch * h, pole_height + 0.5 * pole_stretch * turn * h * h, turn * h, N * h, 0,
            M_PI * pressure(pole_height) * pole_stretch * pole_stretch * h * h;
        double s = h;
        // The first step is the pole's series; the sock's corner lies on a step's end.
        for (const double to : {b_.kind == "sock" ? b_.radius : length_, length_}) {
            const int n = static_cast<int>(std::lround((to - s) / h));
            for (int i = 0; i < n; ++i) {
                const double d = (to - s) / (n - i);
                const bool wall = s + 0.5 * d > b_.radius;
                const State k1 = slope(s, x, wall), k2 = slope(s + 0.5 * d, x + 0.5 * d * k1, wall),
                            k3 = slope(s + 0.5 * d, x + 0.5 * d * k2, wall), k4 = slope(s + d, x + d * k3, wall);
                x += d / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
                s += d;
            }
        }
        return x;
    }
    double least_tension() const { return least_; }

private:
    double pressure(double y) const { return b_.pressure + b_.rho_g * std::max(0.0, b_.head - y); }
    double rest_radius(double s, bool wall) const {
        if (b_.kind == "hemisphere") return b_.radius * std::sin(s / b_.radius);
        return b_.kind == "sock" && wall ? b_.radius : s;
    }
    State slope(double s, const State& x, bool wall) {
        const double R = rest_radius(s, wall), l2 = x[0] / R, l1 = stretch_at(b_.fabric, x[3] / R, l2);
        const double N2 = tension(b_.fabric, l2, l1), p = pressure(x[1]), c = std::cos(x[2]), sn = std::sin(x[2]);
        least_ = std::min(least_, N2);
        State d;
        d << l1 * c, l1 * sn, (p * x[0] * l1 - N2 * sn) / x[3], N2 * c, M_PI * x[0] * x[0] * l1 * sn, 2 * M_PI * p * x[0] * l1 * c;
        return d;
    }
    const Bag& b_;
    double length_, least_ = 0;
};

}  // namespace

Shape solve(const Bag& bag, const Shape& guess) {
    Meridian meridian(bag);
    Unknowns u(guess.pole_stretch, -guess.depth);
    Shape out;
    out.found = shoot(u, [&](const Unknowns& v) {
        const State x = meridian.end(v[0], v[1]);
        return Unknowns(x[0] / bag.radius - 1, x[1] / bag.radius);
    });
    const State x = meridian.end(u[0], u[1]);
    out.pole_stretch = u[0];
    out.depth = -u[1];
    out.volume = x[4];
    out.reaction = x[5];
    out.least_tension = meridian.least_tension();
    return out;
}

/// Half a section from its lowest point: the tension T is the same everywhere, and so is the stretch; phi' = p l / T.
Section solve(const Trough& t, const Section& guess) {
    using Half = Eigen::Vector4d;   // x, y, phi, liquid's area
    double T = 0, l = 1;
    const auto slope = [&](const Half& h) {
        const double c = std::cos(h[2]), s = std::sin(h[2]), under = std::max(0.0, t.head - h[1]);
        return Half(l * c, l * s, t.rho_g * under * l / T, under * l * c);
    };
    const auto end = [&](double stretch, double bottom) {
        l = stretch;
        T = tension(t.fabric, l, 1);
        constexpr int steps = 1000;
        const double d = 0.5 * t.length / steps;
        Half h(0, bottom, 0, 0);
        for (int i = 0; i < steps; ++i) {
            const Half k1 = slope(h), k2 = slope(h + 0.5 * d * k1), k3 = slope(h + 0.5 * d * k2), k4 = slope(h + d * k3);
            h += d / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
        return h;
    };
    Unknowns u(guess.stretch, -guess.depth);
    Section out;
    out.found = shoot(u, [&](const Unknowns& v) {
        const Half h = end(v[0], v[1]);
        return Unknowns(2 * h[0] / t.width - 1, h[1] / t.width);
    });
    const Half h = end(u[0], u[1]);
    out.stretch = u[0];
    out.depth = -u[1];
    out.tension = T;
    out.area = 2 * h[3];
    return out;
}

}  // namespace axisymmetric
