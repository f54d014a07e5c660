#include "formwork/stages/cost_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "arcsim/base/text.hpp"

namespace formwork {
namespace {

/// CPU time of a method relative to the static one: least and most over the cases of docs/speed_accuracy at 4000 vertices.
struct Ratio {
    double least, most;
};
Ratio of_static(SolverMethod m) {
    switch (m) {
        case SolverMethod::static_newton: return {1, 1};
        case SolverMethod::backward_euler: return {2, 25};
        case SolverMethod::newton_euler: return {3, 8};
        case SolverMethod::bdf2: return {5, 15};
        case SolverMethod::dynamic_relaxation: return {2, 40};
        case SolverMethod::projective: return {0.5, 6};
    }
    return {1, 1};
}

}  // namespace

CostEstimate estimate_equilibrium(int vertices, const SolverParams& solver, const MaterialParams& material) {
    const double static_s = 3.0 * std::pow(vertices / 40000., 1.25);   // taut and isotropic: the quickest case
    const bool woven = material.model == FabricModel::tensor;          // unsymmetric: LU
    const bool wrinkles = material.compression == Compression::tension_field;
    const Ratio method = of_static(solver.method);
    CostEstimate e;
    e.least_cpu_s = static_s * (woven ? 3 : 0.7) * method.least;
    e.most_cpu_s = static_s * (woven ? 18 : 1.3) * (wrinkles ? 3 : 1) * method.most;
    const bool lu = woven || solver.linear_solver == LinearSolverChoice::umfpack;
    e.memory_mb = 15 + (lu ? 15e-3 : 6.2e-3) * vertices;
    if (solver.method == SolverMethod::dynamic_relaxation) e.memory_mb = 15 + 2.5e-3 * vertices;
    return e;
}

std::string words(const CostEstimate& e) {
    const auto rounded = [](double v) { return arcsim::format_short(v, 1); };
    return rounded(e.least_cpu_s) + " to " + rounded(e.most_cpu_s) + " s of one core, about " +
           std::to_string(10 * std::lround(std::max(20.0, e.memory_mb) / 10)) + " MB";
}

}  // namespace formwork
