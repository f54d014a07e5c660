#include "formwork/study/tensile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "arcsim/base/error.hpp"
#include "arcsim/material/material_data.hpp"
#include "arcsim/material/stiffness_table.hpp"

namespace formwork {
namespace {

/// Where a strip is taken to: displacement in m, or force in N.
struct Goal {
    double value;
    double measured_force_N = 0, measured_displacement_mm = 0;
    double time_s = -1;   // of the prescribed history; below 0: the clamp's path gives it
};

std::vector<Goal> goals_of(const TensileParams& p, const MeasuredCurve* measured) {
    const bool by_force = p.control == TensileControl::force;
    std::vector<Goal> goals;
    if (measured) {
        for (size_t i = 0; i < measured->force_N.size(); ++i) {
            const double d = measured->displacement_mm[i], F = measured->force_N[i];
            // Clamp and force are synchronised by time (§10); without a clock the clamp's constant speed is one.
            const double time = measured->time_s.empty() ? 60 * d / p.rate_mm_per_min : measured->time_s[i];
            if (d > 0 && F > 0) goals.push_back({by_force ? F : 1e-3 * d, F, d, time});
        }
        return goals;
    }
    const double last = by_force ? p.breaking_force_N.value_or(0) : 1e-3 * p.length_mm * p.max_strain;
    if (!(last > 0))
        throw arcsim::InputError("tensile: control by force needs `measured` or `breaking_force_N`.");
    for (int i = 1; i <= p.steps; ++i) goals.push_back({last * i / p.steps});
    return goals;
}

/// Takes the strip to a goal, or to its breaking force where that comes first.
/// @returns whether it broke
bool follow(const TensileParams& p, const StripLaw& law, ClampedStrip& strip, const Goal& goal, StripState& s) {
    const double strength = p.breaking_force_N.value_or(std::numeric_limits<double>::infinity());
    if (p.control == TensileControl::force) {
        s = strip.load_to(law, s, std::min(goal.value, strength));
        return goal.value >= strength;
    }
    constexpr double largest_strain_step = 0.005;   // a corner of a soft weave can otherwise jump to another branch
    const double from = s.displacement;
    const int n = std::max(1, static_cast<int>(std::ceil((goal.value - from) / (largest_strain_step * 1e-3 * p.length_mm) - 1e-9)));
    for (int i = 1; i <= n; ++i) {
        StripState next = strip.pull_to(law, s, i == n ? goal.value : from + i * (goal.value - from) / n);
        if (next.force < strength) {
            s = std::move(next);
            continue;
        }
        // It breaks on the way: the force is known there, the displacement is not.
        const int iterations = next.iterations;
        s = strip.load_to(law, s, strength);
        s.iterations = std::max(s.iterations, iterations);
        return true;
    }
    return false;
}

TensileCurve pull(const TensileParams& p, const StripLaw& law, double angle_deg, const std::vector<Goal>& goals,
                  const std::function<void()>& done) {
    ClampedStrip strip(make_strip(1e-3 * p.length_mm, 1e-3 * p.width_mm, p.resolution), angle_deg * std::numbers::pi / 180);
    TensileCurve curve;
    curve.angle_deg = angle_deg;
    curve.nodes = static_cast<int>(strip.mesh().X.size());
    StripState s = strip.at_rest();
    for (const Goal& goal : goals) {
        curve.broke = follow(p, law, strip, goal, s);
        TensilePoint t;
        t.displacement_mm = 1e3 * s.displacement;
        t.force_N = s.force;
        const bool clocked = goal.time_s >= 0 && !curve.broke;
        t.time_s = clocked ? goal.time_s : 60 * t.displacement_mm / p.rate_mm_per_min;
        t.stiffness_N_per_mm = 1e-3 * s.stiffness;
        t.mid_width_mm = 2e3 * strip.mid_half_width(s);
        t.residual = s.residual;
        t.measured_force_N = goal.measured_force_N;
        t.measured_displacement_mm = goal.measured_displacement_mm;
        curve.points.push_back(t);
        done();
        if (curve.broke) break;
    }
    curve.iterations = s.iterations;
    return curve;
}

void compare(TensileCurve& curve) {
    double sum = 0, largest = 0;
    for (const TensilePoint& t : curve.points) {
        // With prescribed forces the difference is one of displacements; the tangent turns it into a force.
        const double off = t.force_N - t.measured_force_N +
                           t.stiffness_N_per_mm * (t.measured_displacement_mm - t.displacement_mm);
        sum += off * off;
        largest = std::max(largest, std::abs(t.measured_force_N));
    }
    if (!curve.points.empty() && largest > 0) curve.misfit = std::sqrt(sum / static_cast<double>(curve.points.size())) / largest;
}

}  // namespace

std::unique_ptr<StripLaw> make_strip_law(const MaterialParams& m) {
    if (m.model == FabricModel::tensor)
        return std::make_unique<TableStripLaw>(arcsim::read_material(m.data.path).stretching,
                                               arcsim::StiffnessTable::file_factor * m.stretching_mult);
    return std::make_unique<IsotropicStripLaw>(std::array<double, 4>{m.rest[0], m.rest[1], m.max[0], m.max[1]}, m.stretching_mult,
                                               m.max_stretch);
}

std::vector<TensileCurve> run_tensile(const TensileParams& p, const std::function<void(int, int)>& done) {
    const std::unique_ptr<StripLaw> law = make_strip_law(p.material);
    std::vector<MeasuredCurve> measured;
    if (p.measured) measured = read_measured_curves(p.measured->path);
    std::vector<double> angles = p.angles_deg;
    if (!measured.empty()) {
        angles.clear();
        for (const MeasuredCurve& c : measured) angles.push_back(c.angle_deg);
    }
    std::vector<std::vector<Goal>> goals;
    int all = 0, finished = 0;
    for (size_t i = 0; i < angles.size(); ++i) {
        goals.push_back(goals_of(p, measured.empty() ? nullptr : &measured[i]));
        all += static_cast<int>(goals.back().size());
    }
    std::vector<TensileCurve> curves;
    for (size_t i = 0; i < angles.size(); ++i) {
        try {
            curves.push_back(pull(p, *law, angles[i], goals[i], [&] {
                if (done) done(++finished, all);
            }));
        } catch (const arcsim::NumericalError& e) {
            std::ostringstream where;
            where << "tensile: strip cut at " << angles[i] << " degrees: " << e.what();
            throw arcsim::NumericalError(where.str());
        }
        if (!measured.empty()) compare(curves.back());
    }
    return curves;
}

std::string tensile_csv(const std::vector<TensileCurve>& curves, bool with_measured) {
    std::ostringstream out;
    out.precision(12);
    out << "angle_deg,displacement_mm,force_N,time_s,stiffness_N_per_mm,mid_width_mm,residual";
    out << (with_measured ? ",measured_displacement_mm,measured_force_N\n" : "\n");
    for (const TensileCurve& c : curves)
        for (const TensilePoint& t : c.points) {
            out << c.angle_deg << ',' << t.displacement_mm << ',' << t.force_N << ',' << t.time_s << ',' << t.stiffness_N_per_mm << ','
                << t.mid_width_mm << ',' << t.residual;
            if (with_measured) out << ',' << t.measured_displacement_mm << ',' << t.measured_force_N;
            out << '\n';
        }
    return out.str();
}

}  // namespace formwork
