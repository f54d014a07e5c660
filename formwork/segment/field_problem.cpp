#include "formwork/segment/field_problem.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "arcsim/base/error.hpp"

namespace formwork {
namespace {

/// Lower triangle of the dual graph's matrix: the diagonal, and every neighbour with a larger number.
void build_pattern(const Topology& t, FieldProblem& problem) {
    const int n = problem.n_faces;
    std::vector<int> dual_of(t.edges.size(), -1);
    for (std::size_t k = 0; k < problem.edges.size(); ++k) dual_of[problem.edges[k].edge] = static_cast<int>(k);
    LowerPattern& m = problem.pattern;
    m.n = n;
    m.column.reserve(n + 1);
    problem.edge_entry.assign(problem.edges.size(), -1);
    for (int f = 0; f < n; ++f) {
        m.column.push_back(static_cast<int>(m.row.size()));
        m.row.push_back(f);
        std::array<std::pair<int, int>, 3> below;
        int count = 0;
        for (int k = 0; k < 3; ++k) {
            const int g = t.neighbour(f, k);
            if (g > f) below[count++] = {g, dual_of[t.face_edges[f][k]]};
        }
        std::sort(below.begin(), below.begin() + count);
        for (int k = 0; k < count; ++k) {
            // Two faces may share two edges: one entry for both.
            if (k == 0 || below[k].first != below[k - 1].first) m.row.push_back(below[k].first);
            problem.edge_entry[below[k].second] = static_cast<int>(m.row.size()) - 1;
        }
    }
    m.column.push_back(static_cast<int>(m.row.size()));
}

/// One face of each component that has neither data nor a fixed face: there any constant may be added.
std::vector<int> find_anchors(const Topology& t, const FieldProblem& p) {
    std::vector<int> anchors, stack;
    std::vector<char> seen(p.n_faces, 0);
    for (int seed = 0; seed < p.n_faces; ++seed) {
        if (seen[seed]) continue;
        bool held = false;
        stack.push_back(seed);
        seen[seed] = 1;
        while (!stack.empty()) {
            const int f = stack.back();
            stack.pop_back();
            held |= p.fixed[f] || p.weight[f] > 0;
            for (int k = 0; k < 3; ++k)
                if (const int g = t.neighbour(f, k); g >= 0 && !seen[g]) seen[g] = 1, stack.push_back(g);
        }
        if (!held) anchors.push_back(seed);
    }
    return anchors;
}

}  // namespace

FieldProblem make_field_problem(const Surface& s, const Topology& t, const std::vector<DirectionData>& data,
                                const FieldParams& params) {
    const int n = s.n_faces();
    if (static_cast<int>(data.size()) != n)
        throw arcsim::InputError("cross field: directions for " + std::to_string(data.size()) + " faces, the mesh has " +
                                 std::to_string(n) + ". Give one direction per face, in the faces' order.");
    FieldProblem p;
    p.n_faces = n;
    const std::vector<double> kappa = transport_angles(s, t);
    for (std::size_t e = 0; e < t.edges.size(); ++e)
        if (!t.edges[e].is_boundary())
            p.edges.push_back({static_cast<int>(e), t.edges[e].face[0], t.edges[e].face[1], kappa[e]});
    p.weight.resize(n);
    p.target.resize(n);
    p.fixed.assign(n, 0);
    const double length2 = params.smoothing_length * params.smoothing_length;
    for (int f = 0; f < n; ++f) {
        // A unit edge weight stands for ∫|grad theta|² / sqrt(3) on equilateral faces, hence the sqrt(3).
        const double alpha = length2 > 0 ? arcsim::face_area(s, f) / (std::sqrt(3.0) * length2) : params.alpha;
        p.weight[f] = alpha * data[f].weight;
        p.target[f] = data[f].theta;
        if (!std::isfinite(p.weight[f]) || p.weight[f] < 0 || !std::isfinite(p.target[f]))
            throw arcsim::InputError("cross field: face " + std::to_string(f) +
                                     " has a direction or weight that is not a number, or a weight below 0.");
        p.has_data |= p.weight[f] > 0;
    }
    for (const HardDirection& h : params.hard) {
        if (h.face < 0 || h.face >= n || !std::isfinite(h.theta))
            throw arcsim::InputError("cross field: a hard direction names face " + std::to_string(h.face) +
                                     ", the mesh has " + std::to_string(n) + " faces.");
        p.fixed[h.face] = 1;
        p.target[h.face] = h.theta;
        p.has_data = true;
    }
    p.anchors = find_anchors(t, p);
    build_pattern(t, p);
    return p;
}

double field_energy(const FieldProblem& problem, const std::vector<double>& theta, const std::vector<int>& period) {
    double energy = 0;
    for (std::size_t k = 0; k < problem.edges.size(); ++k) {
        const double r = residual(problem.edges[k], theta, period[k]);
        energy += r * r;
    }
    for (int f = 0; f < problem.n_faces; ++f)
        if (problem.weight[f] > 0 && !problem.fixed[f]) {
            const double d = wrap_quarter(theta[f] - problem.target[f]);
            energy += problem.weight[f] * d * d;
        }
    return energy;
}

FieldState match_periods(const FieldProblem& problem, std::vector<double> theta) {
    FieldState s;
    s.theta = std::move(theta);
    for (int f = 0; f < problem.n_faces; ++f)
        if (problem.fixed[f]) s.theta[f] = problem.target[f];
    s.period.resize(problem.edges.size());
    for (std::size_t k = 0; k < problem.edges.size(); ++k)
        s.period[k] = -nearest_quarters(residual(problem.edges[k], s.theta, 0));
    s.energy = field_energy(problem, s.theta, s.period);
    return s;
}

}  // namespace formwork
