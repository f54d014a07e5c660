#pragma once

#include <vector>

#include "arcsim/mesh/topology.hpp"

namespace formwork {

/// a²/(a² + a0²) per face, a = s1 - s2, a0 = max(least_a0, 2 median |a - mean of a around|): differences
/// that are no larger than the field's noise do not count, whatever the mesh's largest one is.
std::vector<double> anisotropy_weights(const arcsim::Topology& t, const std::vector<double>& anisotropy, double least_a0);

}  // namespace formwork
