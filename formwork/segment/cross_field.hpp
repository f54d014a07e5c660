#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "arcsim/base/archive.hpp"
#include "arcsim/mesh/surface.hpp"
#include "arcsim/mesh/topology.hpp"
#include "formwork/segment/direction_data.hpp"

namespace formwork {

/// A direction on every face, known up to quarter turns.
struct CrossField {
    std::vector<double> theta;    // per face: one arm's angle from edge v0->v1, rad
    std::vector<int> period;      // per edge: quarter turns p of (12) between the arms of face[0] and face[1]; 0 on the boundary
    double smoothness_energy = 0; // sum over inner edges of (theta_i - theta_j + kappa_ij + pi/2 p_ij)²   (12)
    double alignment_energy = 0;  // sum over faces of w_f d(theta_f, data_f)², d modulo pi/2
    double energy = 0;            // (12): smoothness + sum of alpha_f w_f d²
    double deviation_deg = 0;     // weighted mean of |d|, degrees
};

/// A node around which the cross turns by a multiple of 90°. Index +1/4 is valence 3, -1/4 valence 5,
/// +1/2 valence 2, -1/2 valence 6.
struct Singularity {
    int node = 0;
    int index4 = 0;   // four times the index
    int valence() const { return 4 - index4; }
};

/// A face whose direction is given: rim, crease or stroke.
struct HardDirection {
    int face = 0;
    double theta = 0;   // rad, from edge v0->v1; known up to quarter turns
};

/// Energy (12) and how its minimum is looked for.
struct FieldParams {
    double alpha = 0.1;            // weight of the data against the smoothness, unit face measure
    double smoothing_length = 0;   // m; > 0 replaces alpha: alpha_f = A_f / (sqrt(3) l²), independent of the resolution
    double singularity_price = 0.1;   // rad² per quarter of singular index: pairs that the data hardly need are cancelled
    int effort = 1;                // 0: diffuse, round and solve only; n: search over the periods, shake n times
    double isotropic_below = 0;    // > 0: second pass, in which faces of less weight follow the others only
    std::vector<HardDirection> hard;
};

template <class Archive>
void visit(Archive& a, FieldParams& p) {
    a.optional("alpha", p.alpha, "", arcsim::non_negative,
               "alpha of (12): weight of the strain's directions against smoothness, each face counting the same.");
    a.optional("smoothing_length", p.smoothing_length, "m", arcsim::non_negative,
               "Length over which noise is smoothed, whatever the resolution; 0: alpha counts.");
    a.optional("singularity_price", p.singularity_price, "rad²", arcsim::non_negative,
               "What a quarter of singular index costs beside (12): pairs that the data hardly need are cancelled.");
    a.optional("isotropic_below", p.isotropic_below, "", arcsim::between(0, 1),
               "Weight below which a face's own direction is dropped and filled in from around in a second pass; 0: one pass.");
    a.optional("search_effort", p.effort, "", arcsim::between(0, 100),
               "0: diffuse, round and solve only; n: search over the periods and shake n times.");
}

/// Told after each step of smooth_cross_field: its name, (12), and (12) with the price of the singularities.
using FieldObserver = std::function<void(const std::string& step, double energy, double cost)>;

/// The smoothest cross field that still follows the data: a minimum of (12),
///
///   E = sum_e (theta_i - theta_j + kappa_ij + pi/2 p_ij)² + sum_f alpha_f w_f d(theta_f, data_f)²
///
/// over angles and periods. Without any data or hard direction the smoothest field of all is returned.
/// The result is the same on every machine and for every number of threads.
/// @param data   one per face; weight 0 where the strain says nothing
/// @throws InputError   data of the wrong length, a hard direction of a face that does not exist
/// @throws NumericalError   the factorisation failed (degenerate faces)
CrossField smooth_cross_field(const Surface& s, const Topology& t, const std::vector<DirectionData>& data,
                              const FieldParams& params, const FieldObserver& observer = nullptr);

/// The field that has these angles, with the period on every edge nearest to its neighbours' (principal
/// matching), and its energies. Also the evaluator for a field from elsewhere.
CrossField match_cross_field(const Surface& s, const Topology& t, const std::vector<double>& theta,
                             const std::vector<DirectionData>& data, const FieldParams& params);

/// Inner nodes with an index other than 0, in the order of their numbers. Closed surface: the indices sum
/// to the Euler characteristic. With a boundary: they and boundary_turning4() do.
/// Asserted: index sum + boundary turning = Euler characteristic.
std::vector<Singularity> find_singularities(const Surface& s, const Topology& t, const CrossField& field);

/// Four times the turning of the boundary against the field, a whole number per loop of
/// Topology::boundary_loops: by how many quarter turns more the tangent turns than the field does.
std::vector<int> loop_turning4(const Surface& s, const Topology& t, const CrossField& field);

/// Sum of loop_turning4 over all loops; 0 on a closed surface.
int boundary_turning4(const Surface& s, const Topology& t, const CrossField& field);

}  // namespace formwork
