#pragma once

#include <string>

#include "formwork/equilibrium/solver_params.hpp"
#include "formwork/fabric/material_params.hpp"

namespace formwork {

/// What finding one equilibrium is likely to take on one thread of a 2023 server core: fitted to the runs of
/// docs/speed_accuracy (250 to 160 000 vertices). Wrinkles and weaves make the range wide.
struct CostEstimate {
    double least_cpu_s = 0, most_cpu_s = 0;
    double memory_mb = 0;
};
CostEstimate estimate_equilibrium(int vertices, const SolverParams& solver, const MaterialParams& material);

/// "0.2 to 0.8 s of one core, 45 MB".
std::string words(const CostEstimate& e);

}  // namespace formwork
