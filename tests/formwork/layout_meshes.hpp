#pragma once

#include <functional>
#include <vector>

#include "formwork/segment/segment.hpp"

/// Small surfaces of every topology that the layout must cope with. Metres.
namespace layout_meshes {

using formwork::DirectionData;
using formwork::Surface;

/// nu x nv quads of a map from (u, v) in the unit square, each two triangles; closed where told.
Surface grid(int nu, int nv, bool closed_u, bool closed_v,
             const std::function<arcsim::Vector3d(double, double)>& at);
Surface tube(int n_around, int n_along, double radius, double height);      // two rims
Surface cup(int n_around, double radius, double height);                    // flat bottom, one rim
Surface torus(int n_around, int n_section, double big, double small);
Surface icosphere(int subdivisions, double radius);
/// The sphere without the faces above z: one rim.
Surface open_sphere(int subdivisions, double radius, double z);
/// A sphere with three round openings: Euler characteristic -1.
Surface three_way(int subdivisions, double radius);

/// Directions along a vector, projected into every face; weight w.
std::vector<DirectionData> along(const Surface& s, const arcsim::Vector3d& d, double weight);

}  // namespace layout_meshes
