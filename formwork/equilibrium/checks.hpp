#pragma once

#include <string>
#include <vector>

#include "formwork/equilibrium/static_system.hpp"

namespace formwork {

/// Parts of the mesh that hang together by faces and seams; -1: nodes of none.
std::vector<int> connected_parts(const EquilibriumProblem& p, int& n_parts);

/// Rigid motions that neither the held nodes nor the load resist, per part (STABILITY rows 7, 14): the liquid at a level
/// leaves shifts and the turn about the vertical; uniform pressure alone leaves all six.
/// @returns one sentence per part that is free to move; empty: none
std::vector<std::string> free_motions(const EquilibriumProblem& p, bool has_liquid, bool has_weight);

/// N = rho g R² / k (STABILITY row 16): far above 1 no fabric holds the load, and units are the usual reason.
double load_number(const StaticSystem& s);

}  // namespace formwork
