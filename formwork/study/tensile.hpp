#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "formwork/fabric/tensile_params.hpp"
#include "formwork/study/clamped_strip.hpp"
#include "formwork/study/measured_curves.hpp"

namespace formwork {

/// One point of a simulated curve.
struct TensilePoint {
    double displacement_mm = 0, force_N = 0, time_s = 0;
    double stiffness_N_per_mm = 0, mid_width_mm = 0, residual = 0;
    double measured_force_N = 0, measured_displacement_mm = 0;   // with a measured curve
};

/// Force against displacement of one strip; the displacement is the one between the centres of the clamped edges.
struct TensileCurve {
    double angle_deg = 0;
    std::vector<TensilePoint> points;   // without the start at rest
    bool broke = false;                 // ended at the breaking force, which its last point has
    int iterations = 0, nodes = 0;
    double misfit = -1;                 // rms of (simulated - measured force) over the largest measured one; -1: nothing measured
};

/// The law of a fabric for the flat strip. @throws InputError: the material file; a law the strip does not know
std::unique_ptr<StripLaw> make_strip_law(const MaterialParams& m);

/// Pulls a strip cut at each angle, from rest, quasi-statically.
/// @param done  called with (finished points, all points)
/// @throws NumericalError: a strip without equilibrium, naming angle and displacement
std::vector<TensileCurve> run_tensile(const TensileParams& p, const std::function<void(int, int)>& done = {});

/// angle_deg,displacement_mm,force_N,time_s,stiffness_N_per_mm,mid_width_mm,residual[,measured_...]: its first three columns
/// can be measured curves of `fit`.
std::string tensile_csv(const std::vector<TensileCurve>& curves, bool with_measured);

}  // namespace formwork
