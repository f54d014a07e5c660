#pragma once

#include <string>
#include <vector>

#include "arcsim/base/archive.hpp"
#include "arcsim/mesh/surface.hpp"
#include "arcsim/mesh/topology.hpp"
#include "formwork/strain/strain_field.hpp"

namespace formwork {

using arcsim::Surface;
using arcsim::Topology;

/// What the strain says about one face: a direction that the weave should follow, and how much it matters.
struct DirectionData {
    double theta = 0;    // angle of the first principal direction from edge v0->v1, ccw about the normal, rad
    double s1 = 1, s2 = 1;   // principal stretches along theta and across it
    double weight = 0;   // 0: no preference; 1: fully anisotropic
};

/// How anisotropy becomes weight. Absolute, never normalised per mesh: on an evenly blown sphere that would
/// promote noise to data.
struct DirectionParams {
    double anisotropy = 0.01;   // least a0: the stretch difference s1 - s2 that counts half; noise of the field can raise it
    int averaging_rings = 1; // rings of faces over which the strain tensor is averaged before directions are taken
};

template <class Archive>
void visit(Archive& a, DirectionParams& p) {
    a.optional("anisotropy", p.anisotropy, "", arcsim::positive,
               "Difference of the principal stretches at which a direction counts half; twice the field's noise when that is more.");
    a.optional("averaging_rings", p.averaging_rings, "", arcsim::between(0, 20),
               "Rings of faces over which the strain tensor is averaged before directions are taken.");
}

/// Direction and weight per face from the strain on the rest surface (right singular vectors of F).
///
/// Tensors C - I are averaged (area-weighted, transported into the face's frame) before eigenvectors are taken:
/// tensors average, angles do not. The weight is a²/(a² + a0²) with a = s1 - s2 and
/// a0 = max(`anisotropy`, 2 median |a - mean of a around|).
/// Wrinkled faces: the direction along the tension is reliable. Slack faces say nothing: weight 0.
std::vector<DirectionData> directions_from_strain(const Surface& rest, const Topology& t, const StrainField& strain,
                                                  const DirectionParams& params);

/// One line per face: `theta s1 s2 [weight]`; empty lines and lines that start with # are skipped. Without
/// the fourth column the weight comes from s1 - s2 as in directions_from_strain.
/// @throws InputError   unreadable, a line that is not 3 or 4 finite numbers, a stretch <= 0, a weight < 0,
///                      another number of lines than there are faces; names file and line
std::vector<DirectionData> read_field_file(const std::string& path, const Topology& t, const DirectionParams& params);

}  // namespace formwork
