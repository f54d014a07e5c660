// Ruin and recreate: a panel and some of its neighbours are joined and laid out anew, beginning with another cut. What
// single joins and splits cannot reach, two long halves of an ear in place of rings and a cap, is found this way.

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "formwork/segment/layout.hpp"
#include "formwork/segment/surface_curve.hpp"

namespace formwork {
namespace {

constexpr int first_cuts = 4;          // that a new layout of a group is begun with
constexpr double taste_share = 0.7;    // of all work: beyond it, panels that only look bad are left alone
constexpr double least_gain = 0.02;    // in panels: for less, a layout is not changed
constexpr double bad_taste = 0.25;     // in panels: what a panel's outline costs
constexpr int most_neighbours = 3;     // of a panel, longest border first, that are joined one or two at a time
constexpr double far_apart = 0.12;     // of the group's size: distance between the first cuts' middles
constexpr double largest_group = 1.0;  // of the surface

}  // namespace

double Layout::cost() {
    const Surface& s = cut_.surface();
    double length = 0, area = 0, sum = 0;
    for (int f = 0; f < s.n_faces(); ++f) {
        if (panels_[panel_[f]].frozen) continue;
        for (int k = 0; k < 3; ++k) {
            const int a = s.faces[f][k], b = s.faces[f][(k + 1) % 3];
            if (a < b && cut_.is_seam_at(f, k)) length += (s.x[a] - s.x[b]).norm();
        }
    }
    for (int p = 0; p < static_cast<int>(panels_.size()); ++p)
        if (panels_[p].alive && !panels_[p].frozen) {
            sum += panel_cost(quality(p), rules_);
            area += quality(p).area;
        }
    return sum + length / std::sqrt(area);
}

bool Layout::keeps_bounds() {
    for (int p = 0; p < static_cast<int>(panels_.size()); ++p)
        if (panels_[p].alive && !panels_[p].frozen && !formwork::keeps_bounds(quality(p), rules_)) return false;
    return n_panels() <= limits_.max_panels;
}

/// The panel alone, where another may be added, or with one, two or all of its neighbours; smallest groups first.
std::vector<std::vector<int>> Layout::groups_around(int seed, GroupSize size, const Borders& all) {
    std::vector<std::pair<double, int>> next;
    for (const auto& [pair, border] : all) {
        if (pair.first == pair.second || border.is_given || (pair.first != seed && pair.second != seed)) continue;
        next.emplace_back(-border.length, pair.first == seed ? pair.second : pair.first);
    }
    std::sort(next.begin(), next.end());
    const std::size_t n = std::min<std::size_t>(next.size(), most_neighbours);
    std::vector<std::vector<int>> groups;
    if (size == GroupSize::alone && n_panels() < limits_.max_panels && !formwork::keeps_bounds(quality(seed), rules_)) groups.push_back({seed});
    if (size == GroupSize::pair)
        for (std::size_t i = 0; i < n; ++i) groups.push_back({seed, next[i].second});
    if (size == GroupSize::triple)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i + 1; j < n; ++j) groups.push_back({seed, next[i].second, next[j].second});
    if (size == GroupSize::ring && next.size() > 2) {
        std::vector<int> small{seed};
        for (const auto& [length, p] : next)
            if (look(p).area < 6 * look(seed).area) small.push_back(p);
        if (small.size() > 3) groups.push_back(small);
    }
    const auto area = [&](const std::vector<int>& group) {
        double sum = 0;
        for (int p : group) sum += look(p).area;
        return sum;
    };
    std::stable_sort(groups.begin(), groups.end(), [&](const auto& a, const auto& b) { return area(a) < area(b); });
    return groups;
}

GroupTrace Layout::trace_of(const std::vector<int>& group) {
    GroupTrace trace{static_cast<int>(group.size()), std::max(0, limits_.max_panels - n_panels()), Vector3d::Zero(), 0, 0};
    for (int p : group) {
        const PanelQuality& q = quality(p);
        trace.centre += q.area * q.centre;
        trace.area += q.area;
        trace.cost += panel_cost(q, rules_);
    }
    trace.centre /= trace.area;
    return trace;
}

/// The least that the panels of the group at work may come to cost, as far as that shows before they are laid flat.
double Layout::group_floor(int most_panels) {
    const bool may_split = n_panels() < most_panels;
    double sum = 0;
    for (int p = 0; p < static_cast<int>(panels_.size()); ++p) {
        if (!panels_[p].alive || panels_[p].frozen || panels_[p].parked) continue;
        const PanelQuality& q = look(p);
        const double whole = panel_cost(panels_[p].assessed ? q : at_best(q), rules_);
        sum += may_split && q.width >= rules_.min_width ? std::min(whole, 2.) : whole;
    }
    return sum;
}

/// Joins the panels of a group and lays them out anew; keeps the cheapest result, if it is cheaper than what was there.
bool Layout::rework(const std::vector<int>& group) {
    double whole = 0;
    for (int p = 0; p < static_cast<int>(panels_.size()); ++p)
        if (panels_[p].alive && !panels_[p].frozen) whole += look(p).area;
    const GroupTrace trace = trace_of(group);
    if (trace.area > largest_group * whole || rules_.memory->is_hopeless(trace)) return false;
    const double before = cost();
    const State old{cut_, panel_, panels_};
    const std::set<int> members(group.begin(), group.end());
    for (const auto& [pair, border] : borders())
        if (!border.is_given && pair.first != pair.second && members.count(pair.first) && members.count(pair.second))
            for (const auto& [i, j] : border.edges) cut_.unmark_seam(i, j);
    const int a = group[0];
    for (int& p : panel_)
        if (members.count(p)) p = a;
    for (int p : group) panels_[p].alive = p == a;
    for (Panel& p : panels_) p.parked = true;
    relabel(a);
    const PanelPatch patch = extract_patch(cut_, faces_of(a));
    std::vector<Curve> cuts;
    if (patch.is_disk()) {
        SplitRules rules = rules_;
        rules.spacing = far_apart * std::sqrt(trace.area);
        rules.calibration = calibration_of(quality(a));
        for (const Split& s : best_splits(patch, field_on(patch), rules, first_cuts)) cuts.push_back(on_cut(patch, s.curve));
    } else {
        cuts.emplace_back();
    }
    const State joined{cut_, panel_, panels_};
    const PanelQuality together = quality(a);
    const bool may_stay_whole = together.is_disk && together.p95 <= rules_.max_distortion;
    const double others = cost() - panel_cost(together, rules_);   // what stays: the other panels and their seams
    const int n_others = n_panels() - 1;
    std::optional<State> best;
    double least = before - least_gain;
    for (const Curve& curve : cuts) {
        restore(joined);
        // A panel costs at least 1, and pruning rarely takes away more than one: with more panels than that, no gain is left.
        const int most = std::min(limits_.max_panels, n_others + static_cast<int>(std::min(1000., least - others)) + 1);
        if (!curve.empty()) {
            const double length = curve_length(cut_.surface(), curve);
            if (cut_.insert_seam(curve).empty()) continue;
            relabel(a);
            if (others + length / std::sqrt(whole) + group_floor(most) >= least) continue;
        }
        refine(most);
        if (may_stay_whole || n_panels() > n_others + 2) prune();
        const double now = cost();
        if (now >= least) continue;
        least = now;
        best.emplace(State{cut_, panel_, panels_});
    }
    restore(best ? *best : old);
    for (Panel& p : panels_) p.parked = false;
    if (!best) rules_.memory->hopeless.push_back(trace);
    return best.has_value();
}

void Layout::restore(const State& s) {
    cut_ = s.cut;
    panel_ = s.panel;
    panels_ = s.panels;
}

/// Panels out of bounds, or hard to sew, the worst first.
std::vector<int> Layout::hard_panels(Rework what) {
    std::vector<std::pair<double, int>> order;
    for (int p = 0; p < static_cast<int>(panels_.size()); ++p) {
        if (!panels_[p].alive || panels_[p].frozen) continue;
        const double cost = panel_cost(quality(p), rules_);
        if (cost > 1 + bad_taste && (what == Rework::all || !formwork::keeps_bounds(quality(p), rules_))) order.emplace_back(-cost, p);
    }
    std::sort(order.begin(), order.end());
    std::vector<int> panels;
    for (const auto& [cost, p] : order) panels.push_back(p);
    return panels;
}

/// Small groups around all hard panels come before larger ones around any: they cost less and pay as often.
bool Layout::rework(Rework what, double most) {
    const auto step = [&] {
        const Borders all = borders();
        const std::vector<int> seeds = hard_panels(what);
        for (GroupSize size : {GroupSize::alone, GroupSize::pair, GroupSize::triple, GroupSize::ring})
            for (int seed : seeds) {
                const double share = formwork::keeps_bounds(quality(seed), rules_) ? taste_share * most : most;
                for (const auto& group : groups_around(seed, size, all))
                    if (rules_.effort->is_left(share) && rework(group)) return true;
            }
        return false;
    };
    bool any = false;
    while (step()) any = true;
    return any;
}

}  // namespace formwork
