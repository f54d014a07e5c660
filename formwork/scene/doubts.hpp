#pragma once

#include <string>
#include <vector>

#include "formwork/load/plaster_params.hpp"
#include "formwork/scene/fixed_selector.hpp"

namespace formwork {

/// Input that is legal and nearly always a slip: each doubt is one sentence that says what to set instead.

/// The bag's mouth looks sideways, as it does when a mesh with y up is read with z up. Empty: no doubt.
std::string doubt_about_up(const arcsim::Surface& s, const arcsim::Topology& t, const Vector3d& up);

/// Densities in g/cm³; levels in mm, below the whole bag or far above it.
/// @param held  3n flags: the rim
std::vector<std::string> doubts_about_plaster(const PlasterParams& p, const arcsim::Surface& s, const std::vector<char>& held,
                                              const Vector3d& up);

}  // namespace formwork
