#include <cassert>
#include <cmath>
#include <numeric>
#include <string>

#include "arcsim/base/error.hpp"
#include "formwork/segment/angle_transport.hpp"
#include "formwork/segment/cross_field.hpp"

namespace formwork {
namespace {

using std::numbers::pi;

/// x / (2 pi) as the whole number that it must be.
int whole_turns(double x, int node) {
    const double turns = x / (2 * pi);
    const double whole = std::round(turns);
    if (!(std::abs(turns - whole) < 1e-6))
        throw arcsim::NumericalError("cross field: the angles about node " + std::to_string(node) +
                                     " do not close. Look for degenerate faces there.");
    return static_cast<int>(whole);
}

/// What the field does about a node, in quarter turns: sums of kappa and p along the fan.
struct FanSum {
    double kappa = 0;
    int period = 0;
};

FanSum sum_fan(const Surface& s, const Topology& t, const std::vector<double>& kappa, const CrossField& field, int node) {
    FanSum sum;
    for (const FanStep& step : fan_steps(s, t, node)) {
        sum.kappa += step.sign * kappa[step.edge];
        sum.period += step.sign * field.period[step.edge];
    }
    return sum;
}

/// The tangent of the rim at node `b` turns by pi - sum of angles; how much of it the field does not follow.
int rim_turning4(const Surface& s, const Topology& t, const FanSum& sum, double turning, int b) {
    const std::vector<int>& fan = t.node_faces[b];
    const auto edge_at = [&](int f, int offset) {   // angle of the rim edge of face f next to b
        for (int k = 0; k < 3; ++k)
            if (s.faces[f][k] == b) return edge_angle(s, f, (k + offset) % 3);
        assert(false);
        return 0.0;
    };
    const double out = edge_at(fan.front(), 2), in = edge_at(fan.back(), 1);
    return 4 * whole_turns(turning - (out + sum.kappa - in), b) - sum.period;
}

}  // namespace

std::vector<Singularity> find_singularities(const Surface& s, const Topology& t, const CrossField& field) {
    const std::vector<double> kappa = transport_angles(s, t), defect = angle_defects(s, t);
    std::vector<Singularity> found;
    int sum4 = 0;
    for (int v = 0; v < s.n_nodes(); ++v) {
        if (t.node_faces[v].empty() || t.is_boundary_node(v)) continue;
        const FanSum sum = sum_fan(s, t, kappa, field, v);
        const int index4 = 4 * whole_turns(defect[v] - sum.kappa, v) - sum.period;
        if (index4 != 0) found.push_back({v, index4});
        sum4 += index4;
    }
    if (sum4 + boundary_turning4(s, t, field) != 4 * t.euler_characteristic())
        throw arcsim::NumericalError("cross field: index sum " + std::to_string(sum4) + "/4 and boundary turning " +
                                     std::to_string(boundary_turning4(s, t, field)) +
                                     "/4 do not add up to the Euler characteristic " +
                                     std::to_string(t.euler_characteristic()) + ". This is a defect of the program.");
    return found;
}

std::vector<int> loop_turning4(const Surface& s, const Topology& t, const CrossField& field) {
    const std::vector<double> kappa = transport_angles(s, t), defect = angle_defects(s, t);
    std::vector<int> turning;
    for (const std::vector<int>& loop : t.boundary_loops) {
        int sum = 0;
        for (int b : loop) sum += rim_turning4(s, t, sum_fan(s, t, kappa, field, b), defect[b], b);
        turning.push_back(sum);
    }
    return turning;
}

int boundary_turning4(const Surface& s, const Topology& t, const CrossField& field) {
    const std::vector<int> loops = loop_turning4(s, t, field);
    return std::accumulate(loops.begin(), loops.end(), 0);
}

}  // namespace formwork
