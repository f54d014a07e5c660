#include "formwork/equilibrium/measure.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace formwork {
namespace {

double lowest_point(const VectorXd& x, const Vector3d& up) {
    double low = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < x.size() / 3; ++i) low = std::min(low, x.segment<3>(3 * i).dot(up));
    return low;
}

double highest_point(const VectorXd& x, const Vector3d& up) { return -lowest_point(x, -up); }

/// Volume below the rim plane; of the whole shape when it is closed or nothing is held. Without liquid, between the rim
/// plane and the bag, on whichever side overpressure has blown it.
double capacity(const StaticSystem& system, const VectorXd& x) {
    const bool has_rim = !system.is_closed() && std::isfinite(system.rim_height());
    const double highest = highest_point(x, system.pressure().up());
    if (!has_rim) return system.pressure().totals(x, highest).volume;
    if (system.has_liquid()) return system.pressure().totals(x, system.rim_height()).volume;
    const LiquidTotals all = system.pressure().totals(x, highest);
    return std::abs(all.volume - (highest - system.rim_height()) * all.waterplane);
}

FaceStrain face_strain(const EquilibriumProblem& p, const MembraneForce& membrane, const VectorXd& x,
                       const VectorXd& rest, int f) {
    FaceStrain s;
    const Matrix32d F = membrane.deformation(x, f), F_rest = membrane.deformation(rest, f);
    const Vector3d e = membrane.strain(x, f);
    s.eps_uu = e[0];
    s.eps_vv = e[1];
    s.eps_uv = e[2];
    const double m = 0.5 * (e[0] + e[1]), h = 0.5 * (e[0] - e[1]), R = std::hypot(h, e[2]);
    s.lambda1 = std::sqrt(std::max(0.0, 1 + 2 * (m + R)));
    s.lambda2 = std::sqrt(std::max(0.0, 1 + 2 * (m - R)));
    const double a = R > 0 ? 0.5 * std::atan2(e[2], h) : 0;
    const Vector2d t(std::cos(a), std::sin(a));
    s.dir = (F_rest * t).normalized();
    s.dir_deformed = (F * t).normalized();
    s.state = membrane.law().state(e);
    const Vector3d S = evaluate_one(membrane.law(), e, Want::stress).S;
    const double Sm = 0.5 * (S[0] + S[1]), SR = std::hypot(0.5 * (S[0] - S[1]), S[2]);
    s.tension1 = std::max(0.0, Sm + SR);
    s.tension2 = std::max(0.0, Sm - SR);
    (void)p;
    return s;
}

}  // namespace

WrinkleCount count_wrinkles(const MembraneForce& membrane, const VectorXd& x) {
    WrinkleCount c;
    for (int f = 0; f < membrane.n_faces(); ++f) {
        const FaceState s = membrane.law().state(membrane.strain(x, f));
        c.wrinkled += s == FaceState::wrinkled;
        c.slack += s == FaceState::slack;
    }
    return c;
}

Extent measure_extent(StaticSystem& system, const VectorXd& x) {
    system.update_level(x);
    const double low = lowest_point(x, system.pressure().up());
    if (system.has_liquid())
        return {system.pressure().level() - low, system.pressure().totals(x, system.pressure().level()).volume};
    const double rim = system.rim_height();
    return {std::max(rim - low, highest_point(x, system.pressure().up()) - rim), capacity(system, x)};
}

void measure(const EquilibriumProblem& p, StaticSystem& system, const VectorXd& x, EquilibriumResult& r) {
    const VectorXd rest = flatten(p.rest.x);
    r.x = unflatten(x);
    r.vertices = p.rest.n_nodes();
    r.faces = p.rest.n_faces();
    r.free_dofs = system.fixed().n_free();
    VectorXd g;
    system.gradient(x, g);
    r.support_force_N.setZero();
    for (int d : system.fixed().list()) r.support_force_N[d % 3] += g[d];
    const PressureForce& load = system.pressure();
    const double low = lowest_point(x, load.up());
    const Extent extent = measure_extent(system, x);
    r.fill_level_m = system.has_liquid() ? load.level() : std::numeric_limits<double>::quiet_NaN();
    r.depth_m = extent.depth;
    r.depth_below_rim_m = system.rim_height() - low;
    r.volume_m3 = system.has_liquid() ? extent.volume : 0;
    r.capacity_m3 = capacity(system, x);
    r.liquid_mass_kg = p.plaster.density * r.volume_m3;
    r.orientation = load.orientation();
    const auto [high, lowest] = system.membrane().stretch_range(x);
    r.max_stretch = high;
    r.min_stretch = lowest;
    r.strain.resize(r.faces);
    r.wrinkled_faces = r.slack_faces = 0;
    for (int f = 0; f < r.faces; ++f) {
        r.strain[f] = face_strain(p, system.membrane(), x, rest, f);
        r.wrinkled_faces += r.strain[f].state == FaceState::wrinkled;
        r.slack_faces += r.strain[f].state == FaceState::slack;
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    r.peak_rss_mb = static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace formwork
