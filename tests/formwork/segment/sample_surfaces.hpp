#pragma once

#include <functional>

#include "arcsim/mesh/surface.hpp"

/// Small surfaces made by code, for the tests of segmentation.
namespace formwork::samples {

using arcsim::Surface;
using arcsim::Vector3d;

/// Outside of the union of unit cubes (i, j, k) for which `filled` holds, each side n x n squares, smoothed
/// a little; `open` drops the cube sides (cube, axis, +1/-1) for which it holds. Any genus, any number of rims.
Surface cubes(int nx, int ny, int nz, int n, const std::function<bool(int, int, int)>& filled,
              const std::function<bool(int, int, int, int, int)>& open = nullptr);

/// A slab with `genus` holes through it: closed, Euler characteristic 2 - 2 genus.
Surface slab_with_holes(int genus, int n = 3);

/// Radius 1, midpoints of an icosahedron's edges taken `levels` times.
Surface icosphere(int levels);

/// Flat n x m grid of squares of side h, two triangles each, alternating diagonals.
Surface grid(int n, int m, double h);

/// Ring about z: radii of centre line and tube.
Surface torus(int around, int tube, double major, double minor);

/// Side of a cylinder about z without caps.
Surface tube(int around, int along, double radius, double height);

}  // namespace formwork::samples
