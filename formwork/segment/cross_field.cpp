#include "formwork/segment/cross_field.hpp"

#include <array>
#include <cmath>
#include <limits>

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
                              const FieldParams& params, const FieldObserver& observer) {
    const FieldProblem problem = make_field_problem(s, t, data, params);
    const SparseCholesky ordering(problem.pattern);
    const AngleSystem angles(problem, ordering);
    PeriodSearch search(s, t, angles, params.singularity_price);
    const auto report = [&](const std::string& step, const FieldState& state) {
        if (observer) observer(step, state.energy, search.cost(state));
    };

    FieldState best;
    double best_cost = 0;
    double start_energy = std::numeric_limits<double>::infinity();
    const auto try_start = [&](const std::string& name, FieldState state) {
        angles.alternate(state);
        report(name, state);
        if (params.effort > 0) search.descend(state);
        report(name + ", descended", state);
        const double cost = search.cost(state);
        if (!best.theta.empty() && cost >= best_cost) return;
        best_cost = cost;
        best = std::move(state);
    };
    const PowerField power(problem, ordering);
    const std::vector<Complex> linear = power.linear();
    for (const double tau : {10.0, 250.0}) {
        FieldState state = match_periods(problem, angles_of(power.diffuse(linear, tau, 60)));
        angles.alternate(state);
        start_energy = std::min(start_energy, state.energy);
        try_start(tau < 100 ? "diffused over 10" : "diffused over 250", std::move(state));
    }
    // Small diffusions of the best field so far shake loose what single moves cannot: regions whose field
    // would have to turn as a whole.
    for (int shake = 0; shake < params.effort; ++shake) {
        constexpr std::array<double, 3> taus{3, 10, 30};
        std::vector<Complex> z(best.theta.size());
        for (std::size_t f = 0; f < z.size(); ++f) z[f] = std::polar(1.0, 4 * best.theta[f]);
        try_start("shaken", match_periods(problem, angles_of(power.diffuse(z, taus[shake % 3], 5))));
    }
    if (best.energy > start_energy) {   // never more energy than plain diffusion has, whatever the price saved
        PeriodSearch free_of_charge(s, t, angles, 0);
        free_of_charge.descend(best);
        report("descended without price", best);
    }
    return finish(problem, t, data, best);
}

}  // namespace formwork
