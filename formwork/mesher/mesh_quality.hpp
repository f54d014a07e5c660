#pragma once

#include "arcsim/mesh/surface.hpp"

namespace formwork {

/// What a look at the triangles tells. Angles in degrees, lengths in m.
struct MeshQuality {
    double min_angle_deg = 0, max_angle_deg = 0;
    int worst_face = -1;                 // the one with the smallest angle
    int n_below_20 = 0, n_below_5 = 0;   // faces whose smallest angle is below so many degrees
    double min_edge = 0, mean_edge = 0, max_edge = 0;
};
MeshQuality measure_quality(const arcsim::Surface& s);

}  // namespace formwork
