// Ruin and recreate: a panel and some of its neighbours are joined and laid out anew, beginning with another cut. What
// single joins and splits cannot reach, two long halves of an ear in place of rings and a cap, is found this way.

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "formwork/segment/layout.hpp"

namespace formwork {
namespace {

constexpr int first_cuts = 4;          // that a new layout of a group is begun with
constexpr double most_work = 12;       // faces that are laid out anew, all groups and cuts, over the mesh's
constexpr double taste_work = 3;       // the part of it that may go into panels that only look bad
constexpr double least_gain = 0.02;    // in panels: for less, a layout is not changed
constexpr double bad_taste = 0.25;     // in panels: what a panel's outline costs
constexpr int most_neighbours = 3;     // of a panel, longest border first, that are joined one or two at a time
constexpr double far_apart = 0.12;     // of the group's size: distance between the first cuts' middles
constexpr double largest_group = 0.6;  // of the surface

}  // namespace

double Layout::cost() {
    const Surface& s = cut_.surface();
    double length = 0, area = 0, sum = 0;
    for (int f = 0; f < s.n_faces(); ++f) {
        if (panels_[panel_[f]].frozen) continue;
        area += arcsim::face_area(s, f);
        for (int k = 0; k < 3; ++k) {
            const int a = s.faces[f][k], b = s.faces[f][(k + 1) % 3];
            if (a < b && cut_.is_seam_at(f, k)) length += (s.x[a] - s.x[b]).norm();
        }
    }
    for (int p = 0; p < static_cast<int>(panels_.size()); ++p)
        if (panels_[p].alive && !panels_[p].frozen) sum += panel_cost(quality(p), rules_);
    return sum + length / std::sqrt(area);
}

bool Layout::keeps_bounds() {
    for (int p = 0; p < static_cast<int>(panels_.size()); ++p)
        if (panels_[p].alive && !panels_[p].frozen && !formwork::keeps_bounds(quality(p), rules_)) return false;
    return n_panels() <= limits_.max_panels;
}

/// The panel with one, two or all of its neighbours.
std::vector<std::vector<int>> Layout::groups_around(int seed) {
    std::vector<std::pair<double, int>> next;
    for (const auto& [pair, border] : borders()) {
        if (pair.first == pair.second || border.is_given || (pair.first != seed && pair.second != seed)) continue;
        next.emplace_back(-border.length, pair.first == seed ? pair.second : pair.first);
    }
    std::sort(next.begin(), next.end());
    const std::size_t n = std::min<std::size_t>(next.size(), most_neighbours);
    std::vector<std::vector<int>> groups;
    for (std::size_t i = 0; i < n; ++i) groups.push_back({seed, next[i].second});
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) groups.push_back({seed, next[i].second, next[j].second});
    if (next.size() > 2) {
        std::vector<int> small{seed};
        for (const auto& [length, p] : next)
            if (quality(p).area < 6 * quality(seed).area) small.push_back(p);
        if (small.size() > 3) groups.push_back(small);
    }
    const auto area = [&](const std::vector<int>& group) {
        double sum = 0;
        for (int p : group) sum += quality(p).area;
        return sum;
    };
    std::stable_sort(groups.begin(), groups.end(), [&](const auto& a, const auto& b) { return area(a) < area(b); });   // cheapest first
    return groups;
}

/// Joins the panels of a group and lays them out anew; keeps the cheapest result, if it is cheaper than what was there.
bool Layout::rework(const std::vector<int>& group, double& work_left) {
    double area = 0, whole = 0;
    for (const Panel& p : panels_)
        if (p.alive && !p.frozen) whole += p.quality.area;
    for (int p : group) area += quality(p).area;
    if (area > largest_group * whole) return false;
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
        rules.spacing = far_apart * std::sqrt(area);
        rules.calibration = calibration_of(quality(a));
        for (const Split& s : best_splits(patch, field_on(patch), rules, first_cuts)) cuts.push_back(on_cut(patch, s.curve));
    } else {
        cuts.emplace_back();
    }
    work_left -= static_cast<double>(cuts.size() * patch.surface.faces.size());
    const State joined{cut_, panel_, panels_};
    const double others = cost() - panel_cost(quality(a), rules_);   // what stays: the other panels and their seams
    const int n_others = n_panels() - 1;
    std::optional<State> best;
    double least = before - least_gain;
    for (const Curve& curve : cuts) {
        restore(joined);
        if (!curve.empty()) {
            if (cut_.insert_seam(curve).empty()) continue;
            relabel(a);
        }
        // A panel costs at least 1, and pruning rarely takes away more than one: with more panels than that, no gain is left.
        refine(std::min(limits_.max_panels, n_others + static_cast<int>(std::min(1000., least - others)) + 1));
        prune();
        const double now = cost();
        if (now >= least) continue;
        least = now;
        best.emplace(State{cut_, panel_, panels_});
    }
    restore(best ? *best : old);
    for (Panel& p : panels_) p.parked = false;
    return best.has_value();
}

void Layout::restore(const State& s) {
    cut_ = s.cut;
    panel_ = s.panel;
    panels_ = s.panels;
}

/// Groups around every panel that is out of bounds or hard to sew, the worst first, until none is left or nothing helps.
bool Layout::rework(Rework what) {
    bool any = false;
    const double all = most_work * cut_.surface().n_faces();
    double left = all;
    std::set<std::vector<std::pair<int, double>>> tried;   // panels of a group and their areas
    for (bool changed = true; changed && left > 0;) {
        changed = false;
        std::vector<std::pair<double, int>> order;
        for (int p = 0; p < static_cast<int>(panels_.size()); ++p)
            if (panels_[p].alive && !panels_[p].frozen && panel_cost(quality(p), rules_) > 1 + bad_taste &&
                (what == Rework::all || !formwork::keeps_bounds(quality(p), rules_)))
                order.emplace_back(-panel_cost(quality(p), rules_), p);
        std::sort(order.begin(), order.end());
        for (const auto& [weight, seed] : order) {
            const double least_left = formwork::keeps_bounds(quality(seed), rules_) ? all - taste_work * cut_.surface().n_faces() : 0;
            for (const auto& group : groups_around(seed)) {
                std::vector<std::pair<int, double>> key;
                for (int p : group) key.emplace_back(p, quality(p).area);
                if (left <= least_left || !tried.insert(key).second) continue;
                if (!rework(group, left)) continue;
                any = changed = true;
                break;
            }
            if (changed) break;
        }
    }
    return any;
}

}  // namespace formwork
