#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "formwork/fabric/tensile_params.hpp"
#include "formwork/study/measured_curves.hpp"
#include "formwork/study/strip_law.hpp"

namespace formwork {

/// One estimated entry of the table.
struct FittedEntry {
    std::string name;
    double value = 0, start = 0;      // N/m, as in the material file
    double deviation = 0;             // standard deviation from the covariance at the solution, N/m
    double influence = 0;             // largest relative change of any used force when the entry doubles, to first order
    bool at_bound = false;
    bool determined = false;          // deviation below a third of the value: the data say what it is
    std::string why;                  // it is not determined; empty when it is
};

/// A used point: measured against fitted.
struct FittedPoint {
    double angle_deg = 0, displacement_mm = 0, measured_N = 0, fitted_N = 0, deviation_N = 0;
};

struct FitResult {
    std::vector<FittedEntry> entries;
    std::vector<FittedPoint> points;
    std::unique_ptr<StripLaw> law;
    double chi2_per_point = 0;        // 1: the curves agree to within the stated noise
    int iterations = 0, strips = 0;   // Levenberg-Marquardt steps; equilibria computed
    bool converged = false;
};

/// Estimates a stiffness table from measured curves: Levenberg-Marquardt on
///
///   sum over points ((F_simulated - F_measured) / sigma)² + sum over entries ((p - p_start) / (prior_width p_start))²
///
/// with 0 <= p <= largest, F from the simulated strip, and dF/dp from the adjoint of the tangent at each equilibrium: one
/// transposed solve per point for all entries. The second sum is wide; it only holds entries that no force depends on.
/// Uncertainties are the square roots of the inverse of the normal matrix at the solution, scaled up when the misfit is larger
/// than the stated noise.
/// @throws InputError, NumericalError
FitResult fit_table(const FitParams& p, const std::vector<MeasuredCurve>& measured, std::unique_ptr<StripLaw> start,
                    const std::function<void(int, double)>& on_step = {});

/// Where the fit begins without a material file: slopes of the measured curves.
std::unique_ptr<StripLaw> start_from_slopes(const FitParams& p, const std::vector<MeasuredCurve>& measured);

/// entry,value_N_per_m,deviation_N_per_m,determined,influence,at_bound,start_N_per_m,why
std::string fit_csv(const FitResult& r);
/// A material file in ArcSim's format with a comment on every entry that the data do not determine. Tensor fits only.
std::string fitted_material_text(const FitResult& r, double density);

}  // namespace formwork
