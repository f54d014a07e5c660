#include "formwork/segment/period_search.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "formwork/segment/mixed_bits.hpp"

namespace formwork {
namespace {

constexpr double c = quarter_turn;
constexpr double least_gain = 1e-9;        // rad²: below it a trial is rounding noise
constexpr double least_rise = 0.2;         // of c²: lower bound of n - bᵀA⁻¹b, 1/3 on regular meshes; prunes trials
constexpr int settled_nodes = 40;          // about three rings around a singularity are looked at
constexpr int longest_move = 3;            // edges a singularity may move at once; cancellations may be longer

}  // namespace

PeriodSearch::PeriodSearch(const Surface& s, const Topology& t, const AngleSystem& angles, double price)
    : s_(s), t_(t), angles_(angles), problem_(angles.problem()), price_(price) {
    std::vector<int> dual_of(t.edges.size(), -1);
    for (std::size_t k = 0; k < problem_.edges.size(); ++k) dual_of[problem_.edges[k].edge] = static_cast<int>(k);
    rise_.assign(problem_.edges.size(), -1);
    const std::vector<double> defect = angle_defects(s, t);
    fans_.resize(s.x.size());
    base4_.assign(s.x.size(), 0);
    for (int v = 0; v < s.n_nodes(); ++v) {
        if (t.node_faces[v].empty()) continue;
        fans_[v] = fan_steps(s, t, v);
        double turn = defect[v];
        for (FanStep& f : fans_[v]) {
            f.edge = dual_of[f.edge];
            turn -= f.sign * problem_.edges[f.edge].kappa;
        }
        if (!t.is_boundary_node(v)) base4_[v] = nearest_quarters(turn);
    }
}

std::vector<int> PeriodSearch::indices(const FieldState& state) const {
    std::vector<int> index4(s_.x.size(), 0);
    for (int v = 0; v < s_.n_nodes(); ++v) {
        if (t_.is_boundary_node(v)) continue;
        index4[v] = base4_[v];
        for (const FanStep& f : fans_[v]) index4[v] -= f.sign * state.period[f.edge];
    }
    return index4;
}

double PeriodSearch::cost(const FieldState& state) const {
    int count = 0;
    if (price_ > 0)
        for (int index4 : indices(state)) count += std::abs(index4);
    return state.energy + price_ * count;
}

double PeriodSearch::change(const FieldState& state, const std::vector<Step>& steps) const {
    double first = 0;
    for (const Step& step : steps) first += step.sign * residual(problem_.edges[step.dual], state.theta, state.period[step.dual]);
    return 2 * c * first + c * c * (static_cast<double>(steps.size()) - chain_norm(steps));
}

double PeriodSearch::chain_norm(const std::vector<Step>& steps) const {
    std::uint64_t key = steps.size();   // of the chain either way round: a sum over its steps, signs by the lowest edge's
    const int sign = std::min_element(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.dual < b.dual; })->sign;
    for (const Step& step : steps) key += mixed_bits(2 * static_cast<std::uint64_t>(step.dual) + (step.sign == sign));
    const auto [known, is_new] = chain_norm_.try_emplace(key);
    if (!is_new) return known->second;
    std::vector<SparseCholesky::Entry> b;
    for (const Step& step : steps) {
        const DualEdge& e = problem_.edges[step.dual];
        if (!problem_.fixed[e.i]) b.push_back({e.i, static_cast<double>(step.sign)});
        if (!problem_.fixed[e.j]) b.push_back({e.j, static_cast<double>(-step.sign)});
    }
    return known->second = angles_.factor().energy_norm(b);
}

double PeriodSearch::single_edge_rise(int dual) {
    double& rise = rise_[dual];
    if (rise < 0) {
        const DualEdge& e = problem_.edges[dual];
        std::vector<SparseCholesky::Entry> b;
        if (!problem_.fixed[e.i]) b.push_back({e.i, 1.0});
        if (!problem_.fixed[e.j]) b.push_back({e.j, -1.0});
        rise = std::max(0.0, c * c * (1 - angles_.factor().energy_norm(b)));
    }
    return rise;
}

int PeriodSearch::count_change(const std::vector<int>& index4, const std::vector<Step>& steps) const {
    std::vector<std::pair<int, int>> moved;   // node, change of index4
    for (const Step& step : steps)
        for (int v : t_.edges[problem_.edges[step.dual].edge].node) {
            if (t_.is_boundary_node(v)) continue;
            for (const FanStep& f : fans_[v])
                if (f.edge == step.dual) moved.emplace_back(v, -f.sign * step.sign);
        }
    std::sort(moved.begin(), moved.end());
    int sum = 0;
    for (std::size_t i = 0; i < moved.size();) {
        const int v = moved[i].first;
        int here = 0;
        for (; i < moved.size() && moved[i].first == v; ++i) here += moved[i].second;
        sum += std::abs(index4[v] + here) - std::abs(index4[v]);
    }
    return sum;
}

void PeriodSearch::add_edge_trials(const FieldState& state, const std::vector<int>& index4, std::vector<Trial>& list) {
    for (std::size_t k = 0; k < problem_.edges.size(); ++k) {
        const double r = residual(problem_.edges[k], state.theta, state.period[k]);
        // A cancellation saves two quarters at most.
        if (least_rise * c * c - 2 * c * std::abs(r) - 2 * price_ >= 0) continue;
        Trial trial{0, {{static_cast<int>(k), r > 0 ? -1 : 1}}};
        const double without_rise = price_ * count_change(index4, trial.steps) - 2 * c * std::abs(r);
        if (least_rise * c * c + without_rise >= 0) continue;
        trial.gain = single_edge_rise(static_cast<int>(k)) + without_rise;
        if (trial.gain < -least_gain) list.push_back(std::move(trial));
    }
}

/// Chains out of one singularity, cheapest first (Dijkstra on a bound per edge): to nodes a few edges away,
/// to singularities of the other sign, to the boundary.
PeriodSearch::Trial PeriodSearch::best_path_trial(const FieldState& state, const std::vector<int>& index4, int node) const {
    constexpr double typical_rise = 0.33, least_step = 0.02;   // of c²: what a further edge of a chain costs
    struct Reached {
        double cost;
        double first;      // sum s r along the chain
        int from;
        int length;
        Step step;
        bool settled;
    };
    using Item = std::pair<double, int>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    std::unordered_map<int, Reached> reached;
    const int q = index4[node] > 0 ? 1 : -1;
    reached[node] = {0, 0, -1, 0, {}, false};
    queue.push({0, node});
    Trial best;
    for (int settled = 0; !queue.empty() && settled < settled_nodes;) {
        const int v = queue.top().second;
        queue.pop();
        if (reached[v].settled) continue;
        reached[v].settled = true;
        ++settled;
        const Reached here = reached[v];
        const bool cancels = t_.is_boundary_node(v) || index4[v] * q < 0;
        if (here.length > 1 && (here.length <= longest_move || cancels)) {
            const int saved = std::abs(index4[v] + q) - std::abs(index4[v]) - 1 - (t_.is_boundary_node(v) ? 1 : 0);
            if (least_rise * c * c + 2 * c * here.first + price_ * saved < best.gain) {
                Trial trial;
                for (int w = v; w != node; w = reached[w].from) trial.steps.push_back(reached[w].step);
                trial.gain = change(state, trial.steps) + price_ * count_change(index4, trial.steps);
                if (trial.gain < best.gain - least_gain) best = std::move(trial);
            }
        }
        if (t_.is_boundary_node(v)) continue;
        for (const FanStep& f : fans_[v]) {
            const auto& ends = t_.edges[problem_.edges[f.edge].edge].node;
            const int w = ends[0] == v ? ends[1] : ends[0];
            const Step step{f.edge, f.sign * q};
            const double r = step.sign * residual(problem_.edges[f.edge], state.theta, state.period[f.edge]);
            const double next = here.cost + std::max(least_step * c * c, typical_rise * c * c + 2 * c * r);
            const auto it = reached.find(w);
            if (it != reached.end() && (it->second.settled || it->second.cost <= next)) continue;
            reached[w] = {next, here.first + r, v, here.length + 1, step, false};
            queue.push({next, w});
        }
    }
    return best;
}

/// Best first; none within two rings of a better one.
std::vector<PeriodSearch::Trial> PeriodSearch::without_conflicts(std::vector<Trial> list) const {
    std::stable_sort(list.begin(), list.end(), [](const Trial& a, const Trial& b) { return a.gain < b.gain; });
    std::vector<char> taken(s_.x.size(), 0);
    std::vector<Trial> kept;
    for (Trial& trial : list) {
        std::vector<int> nodes;
        for (const Step& step : trial.steps)
            for (int v : t_.edges[problem_.edges[step.dual].edge].node) nodes.push_back(v);
        if (std::any_of(nodes.begin(), nodes.end(), [&](int v) { return taken[v]; })) continue;
        for (int v : nodes)
            for (int f : t_.node_faces[v])
                for (int w : s_.faces[f])
                    for (int g : t_.node_faces[w])
                        for (int u : s_.faces[g]) taken[u] = 1;
        kept.push_back(std::move(trial));
    }
    return kept;
}

/// All trials at once; when their sum disappoints (they interact over long distances), the better half.
bool PeriodSearch::accept(FieldState& state, const std::vector<Trial>& list) const {
    const double before = cost(state);
    for (std::size_t n = list.size(); n > 0; n /= 2) {
        FieldState next = state;
        for (std::size_t i = 0; i < n; ++i)
            for (const Step& step : list[i].steps) next.period[step.dual] += step.sign;
        angles_.alternate(next);
        if (cost(next) < before - least_gain) {
            state = std::move(next);
            return true;
        }
    }
    return false;
}

/// What a singularity sees of the field around it.
std::vector<double> PeriodSearch::signature(const FieldState& state, int node) const {
    std::vector<double> r;
    for (const FanStep& f : fans_[node]) r.push_back(residual(problem_.edges[f.edge], state.theta, state.period[f.edge]));
    return r;
}

int PeriodSearch::descend(FieldState& state) {
    constexpr int max_rounds = 400;
    constexpr double same = 5e-4;   // rad: a singularity that saw no larger change has no new way to go
    std::unordered_map<int, std::vector<double>> tried;
    angles_.alternate(state);
    int round = 0;
    for (; round < max_rounds; ++round) {
        const std::vector<int> index4 = indices(state);
        std::vector<Trial> list;
        add_edge_trials(state, index4, list);
        if (!list.empty() && accept(state, without_conflicts(std::move(list)))) continue;
        list.clear();
        for (int v = 0; v < s_.n_nodes(); ++v) {
            if (index4[v] == 0) continue;
            std::vector<double> now = signature(state, v);
            std::vector<double>& before = tried[v];
            double change_seen = before.empty() ? 1 : 0;
            for (std::size_t i = 0; i < before.size(); ++i) change_seen = std::max(change_seen, std::abs(before[i] - now[i]));
            if (change_seen < same) continue;
            Trial trial = best_path_trial(state, index4, v);
            if (trial.gain < -least_gain) list.push_back(std::move(trial));
            else before = std::move(now);
        }
        if (list.empty() || !accept(state, without_conflicts(std::move(list)))) break;
    }
    return round;
}

}  // namespace formwork
