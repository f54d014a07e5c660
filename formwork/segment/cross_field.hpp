#pragma once

#include <array>
#include <vector>

#include "arcsim/mesh/surface.hpp"
#include "arcsim/mesh/topology.hpp"

namespace formwork {

using arcsim::Surface;
using arcsim::Topology;

/// What the strain says about one face: a direction that the weave should follow, and how much it matters.
struct DirectionData {
    double theta = 0;    // angle of the first principal direction from edge v0->v1, ccw about the normal, rad
    double s1 = 1, s2 = 1;   // principal stretches along theta and across it
    double weight = 0;   // 0: no preference; 1: fully anisotropic
};

/// A direction on every face, known up to quarter turns.
struct CrossField {
    std::vector<double> theta;    // per face: one arm's angle from edge v0->v1, rad
    std::vector<int> period;      // per edge: quarter turns between the arms of face[0] and face[1]; 0 on the boundary
    double smoothness_energy = 0; // sum over inner edges of (theta_i - theta_j + kappa_ij + pi/2 p_ij)²   (12)
    double alignment_energy = 0;  // sum over faces of w_f d(theta_f, data_f)², d modulo pi/2
    double deviation_deg = 0;     // weighted mean of |d|, degrees
};

/// A node around which the cross turns by a multiple of 90°. Index +1/4 is valence 3, -1/4 valence 5,
/// +1/2 valence 2, -1/2 valence 6.
struct Singularity {
    int node = 0;
    int index4 = 0;   // four times the index
    int valence() const { return 4 - index4; }
};

}  // namespace formwork
