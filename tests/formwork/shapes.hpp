#pragma once

#include <vector>

#include "arcsim/mesh/surface.hpp"

/// Small meshes for tests: exact rims, no randomness. Normals of closed-bottom shapes point outward (down).
namespace shapes {

using arcsim::Surface;

struct Bag {
    Surface surface;
    std::vector<char> held;   // 3n flags
};

/// Flat disk of radius a at z = 0 in hexagonal rings: 1 + 3 n (n + 1) nodes, rim nodes on the circle and held.
Bag disk(double a, int n);
/// Cylinder of radius a from z = 0 (held rim) down to -h, closed by a disk of n rings.
Bag sock(double a, double h, int n);
/// Half sphere of radius a below its held rim.
Bag hemisphere(double a, int n);
/// Square of side w in n x n cells, diagonals alternating, at z = 0; its border held.
Bag square(double w, int n);
/// Strip of length L along x and width w along y in nx x ny cells; the ends x = 0 and x = L held, y held everywhere.
Bag trough(double L, double width, int nx, int ny);

/// Moves every free node by at most `amplitude`, always the same way for the same seed.
void jiggle(std::vector<arcsim::Vector3d>& x, const std::vector<char>& held, double amplitude, int seed);

arcsim::VectorXd flatten(const std::vector<arcsim::Vector3d>& x);

}  // namespace shapes
