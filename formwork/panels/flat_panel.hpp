#pragma once

#include <vector>

#include "arcsim/base/types.hpp"

namespace formwork {

using arcsim::Triangle;
using arcsim::Vector2d;

/// One piece of cloth: a disk of the cut mesh laid flat, warp along u.
struct FlatPanel {
    int id = 0;                       // panel number, 0-based; printed 1-based
    std::vector<int> node;            // per local vertex: node of Segmentation::mesh (twice along a dart)
    std::vector<int> face;            // per local face: face of Segmentation::mesh
    std::vector<Triangle> faces;      // local vertex indices, counter-clockwise in the plane
    std::vector<Vector2d> u;          // flat rest coordinates, m; first axis warp, second weft; seen from outside
    std::vector<int> boundary;        // local vertices of the outline, counter-clockwise

    double area = 0, rest_area = 0;   // flat and on the surface, m²
    double max_stretch_distortion = 0;   // largest |sigma - 1| over the faces
    double mean_stretch_distortion = 0;  // area-weighted mean of max |sigma - 1|
    double p95_stretch_distortion = 0;   // 95 % of the area stays below it
    std::vector<double> face_distortion; // per face: max |sigma - 1|
    double symmetric_dirichlet = 4;      // area mean of s1² + s2² + 1/s1² + 1/s2²
    double grain_deviation_deg = 0;      // weighted mean angle between weave and strain directions, modulo 90°
    std::vector<double> grain_error_deg; // per face: angle between its target direction and the weave, modulo 90°
    double grain_coherence = 1;          // |sum A w e^{4 i psi}| / sum A w: how well one grain serves the panel
    int flips = 0;
    bool overlaps = false;
};

}  // namespace formwork
