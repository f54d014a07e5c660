#include "formwork/segment/cross_field.hpp"

#include <cmath>

#include "formwork/segment/field_problem.hpp"
#include "formwork/segment/period_search.hpp"

namespace formwork {
namespace {

/// Angles into [-pi/4, pi/4], periods to match, energies of (12) with the weights as given.
CrossField finish(const FieldProblem& problem, const Topology& t, const std::vector<DirectionData>& data,
                  const FieldState& state) {
    CrossField field;
    field.theta.resize(state.theta.size());
    std::vector<int> turned(state.theta.size());
    for (std::size_t f = 0; f < state.theta.size(); ++f) {
        field.theta[f] = wrap_quarter(state.theta[f]);
        turned[f] = nearest_quarters(state.theta[f] - field.theta[f]);
    }
    field.period.assign(t.edges.size(), 0);
    for (std::size_t k = 0; k < problem.edges.size(); ++k) {
        const DualEdge& e = problem.edges[k];
        field.period[e.edge] = state.period[k] + turned[e.i] - turned[e.j];
        const double r = residual(e, field.theta, field.period[e.edge]);
        field.smoothness_energy += r * r;
    }
    double weights = 0, deviation = 0, weighted = 0;
    for (std::size_t f = 0; f < data.size(); ++f) {
        const double d = wrap_quarter(field.theta[f] - data[f].theta);
        field.alignment_energy += data[f].weight * d * d;
        weighted += problem.fixed[f] ? 0 : problem.weight[f] * d * d;
        deviation += data[f].weight * std::abs(d);
        weights += data[f].weight;
    }
    field.energy = field.smoothness_energy + weighted;
    field.deviation_deg = weights > 0 ? deviation / weights * 180 / std::numbers::pi : 0;
    return field;
}

}  // namespace

CrossField match_cross_field(const Surface& s, const Topology& t, const std::vector<double>& theta,
                             const std::vector<DirectionData>& data, const FieldParams& params) {
    const FieldProblem problem = make_field_problem(s, t, data, params);
    return finish(problem, t, data, match_periods(problem, theta));
}

CrossField smooth_cross_field(const Surface& s, const Topology& t, const std::vector<DirectionData>& data,
                              const FieldParams& params) {
    const FieldProblem problem = make_field_problem(s, t, data, params);
    const SparseCholesky ordering(problem.pattern);
    const PowerField power(problem, ordering);
    const AngleSystem angles(problem, ordering);
    const std::vector<Complex> start = power.linear();
    PeriodSearch search(s, t, angles, params.singularity_price);
    FieldState best;
    double best_cost = 0;
    for (const double tau : {10.0, 250.0}) {
        FieldState state = match_periods(problem, angles_of(power.diffuse(start, tau, 60)));
        search.descend(state);
        const double cost = search.cost(state);
        if (!best.theta.empty() && cost >= best_cost) continue;
        best_cost = cost;
        best = std::move(state);
    }
    return finish(problem, t, data, best);
}

}  // namespace formwork
