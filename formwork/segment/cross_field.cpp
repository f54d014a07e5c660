#include "formwork/segment/cross_field.hpp"

#include <cmath>

#include "formwork/segment/field_problem.hpp"

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
                              const FieldParams& params, const FieldObserver& observer) {
    const FieldProblem problem = make_field_problem(s, t, data, params);
    FieldState state = minimise_field(s, t, problem, params, observer);
    if (params.isotropic_below > 0) {
        // Faces that prefer a direction keep the one found; the others follow them and nothing else.
        std::vector<DirectionData> found = data;
        bool has_anisotropic = false;
        for (std::size_t f = 0; f < found.size(); ++f) {
            const bool anisotropic = data[f].weight >= params.isotropic_below;
            found[f].theta = state.theta[f];
            found[f].weight = anisotropic ? 1 : 0;
            has_anisotropic |= anisotropic;
        }
        if (has_anisotropic) {
            const FieldObserver second = [&](const std::string& step, double energy, double cost) {
                if (observer) observer("second pass, " + step, energy, cost);
            };
            state = minimise_field(s, t, make_field_problem(s, t, found, params), params, second);
        }
    }
    return finish(problem, t, data, state);
}

}  // namespace formwork
