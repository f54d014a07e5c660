#include <algorithm>
#include <array>
#include <limits>

#include "formwork/segment/field_problem.hpp"
#include "formwork/segment/period_search.hpp"

namespace formwork {
namespace {

/// The cheapest of the states tried, each descended as far as `effort` asks.
class BestState {
public:
    BestState(const AngleSystem& angles, PeriodSearch& search, int effort, const FieldObserver& observer)
        : angles_(angles), search_(search), effort_(effort), observer_(observer) {}

    void try_start(const std::string& name, FieldState state) {
        angles_.alternate(state);
        report(name, state);
        if (effort_ > 0) {
            search_.descend(state);
            report(name + ", descended", state);
        }
        const double cost = search_.cost(state);
        if (cost >= cost_) return;
        cost_ = cost;
        best_ = std::move(state);
    }
    void report(const std::string& step, const FieldState& state) const {
        if (observer_) observer_(step, state.energy, search_.cost(state));
    }
    FieldState& best() { return best_; }

private:
    const AngleSystem& angles_;
    PeriodSearch& search_;
    int effort_;
    const FieldObserver& observer_;
    FieldState best_;
    double cost_ = std::numeric_limits<double>::infinity();
};

}  // namespace

FieldState minimise_field(const Surface& s, const Topology& t, const FieldProblem& problem, const FieldParams& params,
                          const FieldObserver& observer) {
    constexpr std::array<double, 2> taus{10, 250};          // diffusion: short keeps the data, long removes pairs
    constexpr std::array<double, 3> shakes{3, 10, 30};
    constexpr int max_diffusions = 60, shake_steps = 5;
    const SparseCholesky ordering(problem.pattern);
    const AngleSystem angles(problem, ordering);
    const PowerField power(problem, ordering);
    PeriodSearch search(s, t, angles, params.singularity_price);
    BestState best(angles, search, params.effort, observer);

    const std::vector<Complex> linear = power.linear();
    double start_energy = std::numeric_limits<double>::infinity();
    for (const double tau : taus) {
        FieldState state = match_periods(problem, angles_of(power.diffuse(linear, tau, max_diffusions)));
        angles.alternate(state);
        start_energy = std::min(start_energy, state.energy);
        best.try_start("diffused over " + std::to_string(static_cast<int>(tau)), std::move(state));
    }
    // Small diffusions of the best field so far shake loose what single moves cannot: regions whose field
    // would have to turn as a whole.
    for (int shake = 0; shake < params.effort; ++shake) {
        const double tau = shakes[static_cast<std::size_t>(shake) % shakes.size()];
        std::vector<Complex> z(best.best().theta.size());
        for (std::size_t f = 0; f < z.size(); ++f) z[f] = std::polar(1.0, 4 * best.best().theta[f]);
        best.try_start("shaken", match_periods(problem, angles_of(power.diffuse(z, tau, shake_steps))));
    }
    if (best.best().energy > start_energy) {   // never more energy than plain diffusion has, whatever the price saved
        PeriodSearch free_of_charge(s, t, angles, 0);
        free_of_charge.descend(best.best());
        best.report("descended without price", best.best());
    }
    return std::move(best.best());
}

}  // namespace formwork
