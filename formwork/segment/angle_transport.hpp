#pragma once

#include <numbers>
#include <vector>

#include "arcsim/mesh/surface.hpp"
#include "arcsim/mesh/topology.hpp"

/// Angles on a triangle surface: how a direction of one face reads in the frame of the next. Every
/// per-face angle is measured from edge v0->v1, counter-clockwise about the normal (arcsim::FaceFrame).
namespace formwork {

using arcsim::Surface;
using arcsim::Topology;

constexpr double quarter_turn = std::numbers::pi / 2;

/// `angle` less the nearest multiple of a quarter turn; in [-pi/4, pi/4].
double wrap_quarter(double angle);

/// The multiple of a quarter turn nearest to `angle`, in quarter turns.
int nearest_quarters(double angle);

/// Interior angle of face f at corner k, rad.
double corner_angle(const Surface& s, int f, int k);

/// Angle of face f's edge opposite corner k, walked in the face's own order, in the face's frame, rad.
double edge_angle(const Surface& s, int f, int k);

/// kappa_ij of (12), one per edge: a direction with angle t in the frame of face[0] has the angle t + kappa
/// in the frame of face[1], once the two faces are unfolded into one plane. 0 on the boundary. Rad.
std::vector<double> transport_angles(const Surface& s, const Topology& t);

/// kappa for a step over edge e out of face `from`: transport_angles()[e], or its negative when `from` is face[1].
inline double transport_from(const Topology& t, const std::vector<double>& kappa, int e, int from) {
    return t.edges[e].face[0] == from ? kappa[e] : -kappa[e];
}

/// Per node, rad: 2 pi less the sum of corner angles; on the boundary pi less it (the rim's turning).
/// Their sum is 2 pi times the Euler characteristic.
std::vector<double> angle_defects(const Surface& s, const Topology& t);

/// The edges that a counter-clockwise walk about `node` crosses: m for an inner node (the last one leads
/// back to the first face), m - 1 for a boundary node with m faces; +1 where the walk goes from face[0] to
/// face[1], -1 where it goes back.
struct FanStep {
    int edge;
    int sign;
};
std::vector<FanStep> fan_steps(const Surface& s, const Topology& t, int node);

}  // namespace formwork
