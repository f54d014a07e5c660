#pragma once

#include <vector>

#include "arcsim/mesh/surface.hpp"
#include "arcsim/mesh/topology.hpp"

namespace formwork {

using arcsim::Surface;
using arcsim::Topology;

/// How far the surface about each node is from bending one way only (14): the smallest eigenvalue of
///
///   sum over the faces at the node of theta n nᵀ,   theta: the face's corner angle, n: its normal
///
/// 0 where all normals lie in one plane: flat, cylinder, cone, a straight hinge. Without unit; independent
/// of scale, and its sum over a surface of resolution: on a sphere 1.16 times the total curvature. This is the
/// plain form of the source's text; Stein, Grinspun, Crane (2018) use normals log-mapped into the node's
/// tangent plane, whose sums differ by 0.2 to 14 %. Rim nodes: 0, since a rim may bend as it likes.
/// Noise counts: smooth a simulated surface first.
std::vector<double> covariance_eta(const Surface& s, const Topology& t);

/// Energy (15) of each panel: sum of eta over the nodes all of whose faces belong to it. Nodes on seams do
/// not count: a seam takes up what bends there.
/// @param panel   per face, 0 .. n_panels - 1
std::vector<double> panel_energies(const Topology& t, const std::vector<double>& eta, const std::vector<int>& panel,
                                   int n_panels);

/// The same for one set of faces.
double patch_energy(const Topology& t, const std::vector<double>& eta, const std::vector<int>& faces);

/// Energy (15) at which a dome flattened conformally stretches by +-`stretch`: a cap of curvature Omega
/// spreads log-scales of +-Omega/(8 pi), and eta sums to 1.16 Omega. Good below 15 % stretch; a trigger, not a
/// verdict: saddle and dome cancel when flattened but add up here.
double energy_for_stretch(double stretch);
double stretch_for_energy(double energy);

}  // namespace formwork
