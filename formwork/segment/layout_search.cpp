// How a layout looks for few panels: splits those that are out of bounds, then merges and tries other seams.

#include <algorithm>
#include <bit>
#include <cmath>

#include "formwork/segment/cut_pieces.hpp"
#include "formwork/segment/layout.hpp"

namespace formwork {
namespace {

constexpr double improving_share = 0.4;   // of all work, that moving single seams may take

}  // namespace

Curve Layout::on_cut(const PanelPatch& patch, Curve curve) {
    for (CurvePoint& p : curve) {
        p.a = patch.node[p.a];
        if (p.b >= 0) p.b = patch.node[p.b];
    }
    return curve;
}

std::vector<Layout::Trial> Layout::try_splits(const PanelPatch& patch, const PanelQuality& q, int count,
                                              std::vector<CandidateCurve>* all) const {
    std::vector<Trial> trials;
    SplitRules rules = rules_;
    rules.calibration = calibration_of(q);
    for (const Split& split : best_splits(patch, field_on(patch), rules, count, all)) {
        Trial trial;
        trial.curve = on_cut(patch, split.curve);
        trial.length = split.length;
        trial.is_allowed = true;
        std::vector<PanelPatch> pieces = split_pieces(patch, split.curve);
        if (pieces.empty()) continue;
        if (q.is_disk) {
            trial.pieces = std::move(pieces);
            for (const PanelPatch& piece : trial.pieces) {
                trial.qualities.push_back(look_at(piece, rules_, rules.calibration));
                trial.excess += excess(trial.qualities.back());
                trial.is_allowed = trial.is_allowed && trial.qualities.back().is_disk &&
                                   trial.qualities.back().corners <= rules_.max_corners;
            }
        }
        trials.push_back(std::move(trial));
    }
    return trials;
}

void Layout::measure_flat(Trial& trial) const {
    trial.excess = 0;
    for (std::size_t i = 0; i < trial.pieces.size(); ++i) {
        formwork::measure_flat(trial.pieces[i], rules_, trial.qualities[i]);
        trial.excess += excess(trial.qualities[i]);
    }
}

bool Layout::split(int panel, bool anyhow) {
    const PanelPatch patch = extract_patch(cut_, faces_of(panel));
    Curve curve;
    if (anyhow) {
        const auto found = plain_split(patch, field_on(patch), rules_);
        if (!found) return false;
        curve = on_cut(patch, found->curve);
    } else {
        const auto trials = try_splits(patch, quality(panel), 3, keeps_candidates_ ? &candidates_ : nullptr);
        if (trials.empty()) return false;
        const double before = excess(quality(panel));
        const auto value = [&](const Trial& t) { return (t.is_allowed ? 1 : 0.1) * (before - t.excess); };
        const auto best = std::max_element(trials.begin(), trials.end(),
                                           [&](const Trial& a, const Trial& b) { return value(a) < value(b); });
        curve = best->curve;
    }
    const bool done = !cut_.insert_seam(curve).empty();
    relabel(panel);
    return done;
}

int Layout::worst_panel() {
    int worst = -1;
    double most = 0;
    for (int p = 0; p < static_cast<int>(panels_.size()); ++p) {
        if (!panels_[p].alive || panels_[p].stuck || panels_[p].frozen || panels_[p].parked) continue;
        const PanelQuality& q = quality(p);
        if (q.is_disk && excess(q) <= 0) continue;
        if (!q.is_disk) return p;
        if (excess(q) > most) {
            most = excess(q);
            worst = p;
        }
    }
    return worst;
}

bool Layout::refine(int most_panels) {
    bool any = false;
    for (int p = worst_panel(); p >= 0; p = worst_panel()) {
        const bool is_disk = quality(p).is_disk;
        if (is_disk && n_panels() >= most_panels) break;
        if (split(p, false) || (!is_disk && split(p, true)))
            any = true;
        else
            panels_[p].stuck = true;
    }
    return any;
}

Layout::Borders Layout::borders() const {
    Borders all;
    const Surface& s = cut_.surface();
    for (int f = 0; f < s.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int i = s.faces[f][k], j = s.faces[f][(k + 1) % 3];
            if (i > j || !cut_.is_seam_at(f, k)) continue;
            const int p = panel_[f], q = panel_[cut_.across(f, k)];
            if (panels_[p].frozen || panels_[q].frozen || (panels_[p].parked && panels_[q].parked)) continue;
            Border& border = all[std::minmax(p, q)];
            border.is_given = border.is_given || cut_.is_given_at(f, k);
            border.length += (s.x[i] - s.x[j]).norm();
            border.edges.emplace_back(i, j);
        }
    return all;
}

/// The two panels as one; the border between them stays marked.
PanelPatch Layout::joined(int a, int b, const Border& border, std::vector<int>& faces) {
    for (const auto& [i, j] : border.edges) cut_.unmark_seam(i, j);
    faces = faces_of(a);
    if (a != b) {
        const std::vector<int> more = faces_of(b);
        faces.insert(faces.end(), more.begin(), more.end());
        std::sort(faces.begin(), faces.end());
    }
    PanelPatch patch = extract_patch(cut_, faces);
    for (const auto& [i, j] : border.edges) cut_.mark_seam(i, j, border.is_given);
    return patch;
}

bool Layout::try_merge(int a, int b, const Border& border) {
    std::vector<int> faces;
    const PanelPatch patch = joined(a, b, border, faces);
    if (!patch.is_disk() || static_cast<int>(corner_nodes(patch, rules_.care).size()) > rules_.max_corners) return false;
    const double allowed = std::max(rules_.max_distortion, a == b ? quality(a).p95 : 0.);
    PanelQuality q = look_at(patch, rules_, std::min(calibration_of(quality(a)), calibration_of(quality(b))));
    if (q.p95 > 1.4 * allowed) return false;
    formwork::measure_flat(patch, rules_, q);
    if (q.p95 > allowed || (q.overlaps && a != b)) return false;
    if (q.solidity < std::min({least_solidity, quality(a).solidity, quality(b).solidity})) return false;
    if (panel_cost(q, rules_) > panel_cost(quality(a), rules_) + (a != b ? panel_cost(quality(b), rules_) : 0)) return false;
    for (const auto& [i, j] : border.edges) cut_.unmark_seam(i, j);
    for (int f : faces) panel_[f] = a;
    if (a != b) panels_[b].alive = false;
    panels_[a] = {.looked_at = true, .assessed = true, .quality = q};
    return true;
}

bool Layout::prune() {
    std::map<std::pair<int, int>, bool> failed;
    bool any = false;
    for (bool merged = true; merged;) {
        merged = false;
        const auto all = borders();
        std::vector<std::pair<double, std::pair<int, int>>> order;
        for (const auto& [pair, border] : all) order.emplace_back(-border.length, pair);
        std::sort(order.begin(), order.end());
        for (const auto& [length, pair] : order) {
            if (failed.count(pair) || all.at(pair).is_given || panels_[pair.first].parked || panels_[pair.second].parked) continue;
            const auto [a, b] = pair;
            if (try_merge(a, b, all.at(pair))) {
                merged = any = true;
                std::erase_if(failed, [a = a, b = b](const auto& item) {
                    const auto [c, d] = item.first;
                    return c == a || c == b || d == a || d == b;
                });
                break;
            }
            failed[pair] = true;
        }
    }
    return any;
}

/// Another seam between two panels, when it leaves less excess, or none and is shorter.
bool Layout::resplit(int a, int b, const Border& border) {
    std::vector<int> faces;
    const PanelPatch patch = joined(a, b, border, faces);
    if (!patch.is_disk()) return false;
    const PanelMemory::Key key = PanelMemory::key_of(patch.surface) + std::bit_cast<PanelMemory::Key>(border.length);
    if (rules_.memory->settled.count(key)) return false;
    const PanelQuality &qa = quality(a), &qb = quality(b);
    const double scale = std::sqrt(calibration_of(qa) * calibration_of(qb));
    auto trials = try_splits(patch, look_at(patch, rules_, scale), 3);
    const double old_excess = excess(qa) + excess(qb);
    const double length_weight = 0.05 * std::sqrt(patch.area());   // m² of excess per m of seam
    const double old_cost = old_excess + length_weight * border.length;
    const auto cost = [&](const Trial& t) { return t.excess + length_weight * t.length; };
    std::erase_if(trials, [&](const Trial& t) { return !t.is_allowed || cost(t) > 0.95 * old_cost; });
    if (trials.empty()) {
        rules_.memory->settled.insert(key);
        return false;
    }
    Trial& best = *std::min_element(trials.begin(), trials.end(), [&](const Trial& s, const Trial& t) { return cost(s) < cost(t); });
    measure_flat(best);
    if (cost(best) > 0.97 * old_cost || best.excess > old_excess + 1e-12) {
        rules_.memory->settled.insert(key);
        return false;
    }
    for (const auto& [i, j] : border.edges) cut_.unmark_seam(i, j);
    cut_.insert_seam(best.curve);   // if it failed, the two stay one panel, to be looked at again
    for (int f = static_cast<int>(panel_.size()); f < cut_.surface().n_faces(); ++f) panel_.push_back(panel_[cut_.split_from(f)]);
    for (int& p : panel_)
        if (p == b) p = a;
    panels_[b].alive = false;
    relabel(a);
    return true;
}

bool Layout::improve() {
    bool any = false;
    std::map<std::pair<int, int>, bool> done;
    for (int changes = 0; changes < 60;) {
        const auto all = borders();
        std::vector<std::pair<double, std::pair<int, int>>> order;
        for (const auto& [pair, border] : all)
            if (pair.first != pair.second && !border.is_given && !done.count(pair))
                order.emplace_back(-excess(quality(pair.first)) - excess(quality(pair.second)) - 1e-6 * border.length, pair);
        std::sort(order.begin(), order.end());
        bool changed = false;
        for (const auto& [weight, pair] : order) {
            done[pair] = true;
            const auto [a, b] = pair;
            if (!rules_.effort->is_left(improving_share)) break;
            if (!resplit(a, b, all.at(pair))) continue;
            any = changed = true;
            ++changes;
            break;   // borders and panel numbers have changed
        }
        if (!changed) break;
    }
    return any;
}

void Layout::search() {
    keeps_candidates_ = true;
    for (int round = 0; round < 3; ++round) {
        refine();
        prune();
        if (!improve() && round > 0) break;
        for (Panel& p : panels_) p.stuck = false;
        prune();
    }
    refine();   // panels that joining has left to spare
    keeps_candidates_ = false;
}

}  // namespace formwork
