#include "formwork/segment/layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "arcsim/base/error.hpp"
#include "formwork/flatten/flatten.hpp"

namespace formwork {
namespace {

constexpr double hopeless = 2.5;   // times the allowed stretch: such an estimate needs no flattening to be believed
constexpr double usual_calibration = 0.75;   // measured stretch over estimate, typical of panels of mixed shape
constexpr int estimate_cells = 400;

}  // namespace

Layout::Layout(const Surface& input, const std::vector<double>& theta, const std::vector<DirectionData>& data,
               const SplitRules& rules, const LayoutLimits& limits)
    : Layout(input, theta, data, rules, limits, CutMesh(input)) {}

Layout::Layout(const Surface& input, const std::vector<double>& theta, const std::vector<DirectionData>& data,
               const SplitRules& rules, const LayoutLimits& limits, CutMesh cut)
    : input_(input), rules_(rules), limits_(limits), cut_(std::move(cut)), data_(data) {
    int n = 0;
    panel_ = label_panels(cut_, n);
    panels_.resize(n);
    for (int f = 0; f < input.n_faces(); ++f) {
        const arcsim::FaceFrame frame = arcsim::face_frame(input, f);
        arm_.push_back(frame.direction(theta[f]));
        principal_.push_back(frame.direction(data[f].theta));
    }
}

SurfaceField Layout::field_on(const Surface& mesh, const std::vector<int>& source_face) const {
    SurfaceField field;
    for (int f = 0; f < mesh.n_faces(); ++f) {
        const arcsim::FaceFrame frame = arcsim::face_frame(mesh, f);
        field.theta.push_back(frame.angle(arm_[source_face[f]]));
        field.data.push_back(data_[source_face[f]]);
        field.data.back().theta = frame.angle(principal_[source_face[f]]);
    }
    return field;
}

SurfaceField Layout::field_on(const PanelPatch& patch) const {
    std::vector<int> source;
    for (int f : patch.face) source.push_back(cut_.source_face()[f]);
    return field_on(patch.surface, source);
}

std::vector<int> Layout::faces_of(int panel) const {
    std::vector<int> faces;
    for (std::size_t f = 0; f < panel_.size(); ++f)
        if (panel_[f] == panel) faces.push_back(static_cast<int>(f));
    return faces;
}

int Layout::n_panels() const {
    return static_cast<int>(std::count_if(panels_.begin(), panels_.end(), [](const Panel& p) { return p.alive && !p.frozen; }));
}

void Layout::relabel(int panel) {
    for (int f = static_cast<int>(panel_.size()); f < cut_.surface().n_faces(); ++f)
        panel_.push_back(panel_[cut_.split_from(f)]);
    const std::vector<int> faces = faces_of(panel);
    for (int f : faces) panel_[f] = -1;
    std::vector<int> stack;
    bool first = true;
    for (int seed : faces) {
        if (panel_[seed] >= 0) continue;
        int id = panel;
        if (!first) {
            id = static_cast<int>(panels_.size());
            panels_.emplace_back();
        }
        first = false;
        panels_[id] = {};
        panel_[seed] = id;
        stack.assign(1, seed);
        while (!stack.empty()) {
            const arcsim::Triangle t = cut_.surface().faces[stack.back()];
            stack.pop_back();
            for (int k = 0; k < 3; ++k) {
                const int a = t[k], b = t[(k + 1) % 3], g = cut_.face_left(b, a);
                if (g < 0 || panel_[g] >= 0 || cut_.is_seam(a, b)) continue;
                panel_[g] = id;
                stack.push_back(g);
            }
        }
    }
}

bool Layout::add_curve(const Curve& curve, bool given) {
    const bool done = !cut_.insert_seam(curve, given).empty();
    for (int p = 0, n = static_cast<int>(panels_.size()); p < n; ++p) relabel(p);
    return done;
}

void Layout::keep_one_side(const Vector3d& point, const Vector3d& normal) {
    std::vector<double> side(panels_.size(), 0);
    for (int f = 0; f < cut_.surface().n_faces(); ++f)
        side[panel_[f]] += arcsim::face_area(cut_.surface(), f) * normal.dot(arcsim::face_centroid(cut_.surface(), f) - point);
    for (std::size_t p = 0; p < panels_.size(); ++p) panels_[p].frozen = side[p] < 0;
}

std::vector<char> Layout::kept_faces() const {
    std::vector<char> kept;
    for (int p : panel_) kept.push_back(!panels_[p].frozen);
    return kept;
}

void Layout::merge_images(const std::vector<int>& face_image) {
    std::vector<int> image(panels_.size(), -1);
    for (std::size_t f = 0; f < face_image.size(); ++f) image[panel_[f]] = panel_[face_image[f]];
    const auto all = borders();
    for (const auto& [pair, border] : all)
        if (pair.first != pair.second && image[pair.first] == pair.second && !border.is_given)
            try_merge(pair.first, pair.second, border);
}

/// Everything about a panel but its flat pattern; its stretch is the estimate times `calibration`.
PanelQuality Layout::look_at(const PanelPatch& patch, double calibration) const {
    PanelQuality q;
    q.is_disk = patch.is_disk();
    q.area = patch.area();
    q.p95 = std::numeric_limits<double>::infinity();
    if (!q.is_disk) return q;
    q.corners = static_cast<int>(corner_nodes(patch).size());
    q.width = patch_width(patch);
    q.estimate = StretchModel(patch, estimate_cells).whole().p95;
    q.p95 = calibration * q.estimate;
    return q;
}

void Layout::flatten(const PanelPatch& patch, PanelQuality& q) const {
    if (!q.is_disk || q.is_flattened || q.p95 > hopeless * rules_.max_distortion) return;
    q.is_flattened = true;
    if (q.estimate < 1e-3 * rules_.max_distortion) return;
    try {
        q.p95 = flatten_disk(patch.surface, FlattenParams::fast()).stretch.p95;
    } catch (const arcsim::NumericalError&) {   // cannot be laid flat without folds: as bad as it gets
        q.p95 = std::max(q.estimate, hopeless * rules_.max_distortion);
    }
}

const PanelQuality& Layout::quality(int panel) {
    Panel& p = panels_[panel];
    if (!p.assessed) {
        const PanelPatch patch = extract_patch(cut_, faces_of(panel));
        p.quality = look_at(patch, usual_calibration);
        flatten(patch, p.quality);
        p.assessed = true;
    }
    return p.quality;
}

bool Layout::is_valid(const PanelQuality& q) const {
    return q.is_disk && q.p95 <= rules_.max_distortion && q.corners <= rules_.max_corners;
}

/// How much stretch beyond the bound a panel holds: area times the relative excess, m².
double Layout::excess(const PanelQuality& q) const {
    if (!q.is_disk) return 10 * q.area;
    return q.area * std::max(0., q.p95 / rules_.max_distortion - 1);
}

double Layout::calibration(const PanelQuality& q) const {
    return q.is_flattened && q.estimate > 0 ? std::clamp(q.p95 / q.estimate, 0.4, 1.3) : usual_calibration;
}

std::vector<Layout::Trial> Layout::try_splits(const PanelPatch& patch, const PanelQuality& q, int count) const {
    std::vector<Trial> trials;
    SplitRules rules = rules_;
    rules.calibration = calibration(q);
    for (const Split& split : best_splits(patch, field_on(patch), rules, count)) {
        Trial trial;
        trial.curve = split.curve;
        trial.length = split.length;
        trial.is_allowed = true;
        for (CurvePoint& p : trial.curve) {
            p.a = patch.node[p.a];
            if (p.b >= 0) p.b = patch.node[p.b];
        }
        std::vector<PanelPatch> pieces = split_pieces(patch, split.curve);
        if (pieces.empty()) continue;
        if (q.is_disk) {
            trial.pieces = std::move(pieces);
            for (const PanelPatch& piece : trial.pieces) {
                trial.qualities.push_back(look_at(piece, rules.calibration));
                trial.excess += excess(trial.qualities.back());
                trial.is_allowed = trial.is_allowed && trial.qualities.back().is_disk &&
                                   trial.qualities.back().corners <= rules_.max_corners;
            }
        }
        trials.push_back(std::move(trial));
    }
    return trials;
}

void Layout::flatten(Trial& trial) const {
    trial.excess = 0;
    for (std::size_t i = 0; i < trial.pieces.size(); ++i) {
        flatten(trial.pieces[i], trial.qualities[i]);
        trial.excess += excess(trial.qualities[i]);
    }
}

bool Layout::split(int panel, bool anyhow) {
    const PanelPatch patch = extract_patch(cut_, faces_of(panel));
    Curve curve;
    if (anyhow) {
        const auto found = plain_split(patch, field_on(patch), rules_);
        if (!found) return false;
        curve = found->curve;
        for (CurvePoint& p : curve) {
            p.a = patch.node[p.a];
            if (p.b >= 0) p.b = patch.node[p.b];
        }
    } else {
        const auto trials = try_splits(patch, quality(panel), 3);
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
        if (!panels_[p].alive || panels_[p].stuck || panels_[p].frozen) continue;
        const PanelQuality& q = quality(p);
        if (q.is_disk && q.p95 <= rules_.max_distortion) continue;
        if (!q.is_disk) return p;
        if (excess(q) > most) {
            most = excess(q);
            worst = p;
        }
    }
    return worst;
}

void Layout::refine() {
    for (int p = worst_panel(); p >= 0; p = worst_panel()) {
        const bool is_disk = quality(p).is_disk;
        if (is_disk && n_panels() >= limits_.max_panels) return;
        if (split(p, false)) continue;
        if (!is_disk && split(p, true)) continue;
        panels_[p].stuck = true;
    }
}

std::map<std::pair<int, int>, Layout::Border> Layout::borders() const {
    std::map<std::pair<int, int>, Border> all;
    const Surface& s = cut_.surface();
    for (int f = 0; f < s.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int i = s.faces[f][k], j = s.faces[f][(k + 1) % 3];
            if (i > j || !cut_.is_seam(i, j)) continue;
            const int p = panel_[f], q = panel_[cut_.face_left(j, i)];
            if (panels_[p].frozen || panels_[q].frozen) continue;
            Border& border = all[std::minmax(p, q)];
            border.is_given = border.is_given || cut_.is_given(i, j);
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
    if (!patch.is_disk() || static_cast<int>(corner_nodes(patch).size()) > rules_.max_corners) return false;
    const double allowed = std::max(rules_.max_distortion, a == b ? quality(a).p95 : 0.);
    PanelQuality q = look_at(patch, std::min(calibration(quality(a)), calibration(quality(b))));
    if (q.p95 > 1.4 * allowed) return false;
    flatten(patch, q);
    if (q.p95 > allowed) return false;
    for (const auto& [i, j] : border.edges) cut_.unmark_seam(i, j);
    for (int f : faces) panel_[f] = a;
    if (a != b) panels_[b].alive = false;
    panels_[a] = {.assessed = true, .quality = q};
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
            if (failed.count(pair) || all.at(pair).is_given) continue;
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
    const PanelQuality &qa = quality(a), &qb = quality(b);
    const double scale = std::sqrt(calibration(qa) * calibration(qb));
    auto trials = try_splits(patch, look_at(patch, scale), 3);
    const double old_excess = excess(qa) + excess(qb);
    const double length_weight = 0.05 * std::sqrt(patch.area());   // m² of excess per m of seam
    const double old_cost = old_excess + length_weight * border.length;
    const auto cost = [&](const Trial& t) { return t.excess + length_weight * t.length; };
    std::erase_if(trials, [&](const Trial& t) { return !t.is_allowed || cost(t) > 0.95 * old_cost; });
    if (trials.empty()) return false;
    Trial& best = *std::min_element(trials.begin(), trials.end(), [&](const Trial& s, const Trial& t) { return cost(s) < cost(t); });
    flatten(best);
    if (cost(best) > 0.97 * old_cost || best.excess > old_excess + 1e-12) return false;
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
    for (int round = 0; round < 3; ++round) {
        refine();
        prune();
        if (!improve() && round > 0) break;
        for (Panel& p : panels_) p.stuck = false;
        prune();
    }
}

std::vector<std::string> Layout::violations() {
    std::vector<std::string> lines;
    int n = 0;
    const std::vector<int> number = label_panels(cut_, n);
    const auto percent = [](double v) { return std::to_string(std::lround(1000 * v) / 10.) .substr(0, 4) + " %"; };
    std::vector<char> told(panels_.size(), 0);
    for (std::size_t f = 0; f < panel_.size(); ++f) {
        const int p = panel_[f];
        if (told[p]) continue;
        told[p] = 1;
        const PanelQuality& q = quality(p);
        const std::string name = "panel " + std::to_string(number[f] + 1) + ": ";
        if (!q.is_disk) lines.push_back(name + "is no disk");
        if (q.is_disk && q.p95 > rules_.max_distortion)
            lines.push_back(name + "stretch of " + percent(q.p95) + " (95 % of the area) exceeds max_distortion " +
                            percent(rules_.max_distortion));
        if (q.corners > rules_.max_corners)
            lines.push_back(name + std::to_string(q.corners) + " corners, more than " + std::to_string(rules_.max_corners));
        if (q.is_disk && q.width < rules_.min_width) lines.push_back(name + "narrower than min_width");
    }
    if (n > limits_.max_panels)
        lines.push_back("layout: " + std::to_string(n) + " panels, more than max_panels " + std::to_string(limits_.max_panels));
    return lines;
}

}  // namespace formwork
