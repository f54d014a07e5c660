#include "formwork/segment/layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "arcsim/base/error.hpp"
#include "formwork/flatten/flatten.hpp"

namespace formwork {
namespace {

constexpr double hopeless = 3;   // times the allowed stretch: such an estimate needs no flattening to be believed

}  // namespace

Layout::Layout(const Surface& input, const std::vector<double>& theta, const std::vector<DirectionData>& data,
               const SplitRules& rules, const LayoutLimits& limits)
    : input_(input), rules_(rules), limits_(limits), cut_(input), data_(data), panel_(input.faces.size(), 0), panels_(1) {
    for (int f = 0; f < input.n_faces(); ++f) {
        const arcsim::FaceFrame frame = arcsim::face_frame(input, f);
        arm_.push_back(frame.direction(theta[f]));
        principal_.push_back(frame.direction(data[f].theta));
    }
}

SurfaceField Layout::field_on(const std::vector<int>& faces) const {
    SurfaceField field;
    for (int f : faces) {
        const int source = cut_.source_face()[f];
        const arcsim::FaceFrame frame = arcsim::face_frame(cut_.surface(), f);
        field.theta.push_back(frame.angle(arm_[source]));
        field.data.push_back(data_[source]);
        field.data.back().theta = frame.angle(principal_[source]);
    }
    return field;
}

std::vector<int> Layout::faces_of(int panel) const {
    std::vector<int> faces;
    for (std::size_t f = 0; f < panel_.size(); ++f)
        if (panel_[f] == panel) faces.push_back(static_cast<int>(f));
    return faces;
}

int Layout::n_panels() const {
    return static_cast<int>(std::count_if(panels_.begin(), panels_.end(), [](const Panel& p) { return p.alive; }));
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

void Layout::add_given(const Curve& curve) {
    cut_.insert_seam(curve);
    for (int p = 0, n = static_cast<int>(panels_.size()); p < n; ++p) relabel(p);
}

PanelQuality Layout::assess(const PanelPatch& patch) const {
    PanelQuality q;
    q.is_disk = patch.is_disk();
    q.p95 = std::numeric_limits<double>::infinity();
    if (!q.is_disk) return q;
    q.corners = static_cast<int>(corner_nodes(patch).size());
    q.width = patch_width(patch);
    const double estimate = StretchModel(patch, 400).whole().p95;
    if (estimate > hopeless * rules_.max_distortion) {
        q.p95 = estimate;
        return q;
    }
    try {
        q.p95 = flatten_disk(patch.surface, FlattenParams::fast()).stretch.p95;
    } catch (const arcsim::NumericalError&) {   // cannot be laid flat without folds: as bad as it gets
        q.p95 = std::max(estimate, hopeless * rules_.max_distortion);
    }
    return q;
}

const PanelQuality& Layout::quality(int panel) {
    Panel& p = panels_[panel];
    if (!p.assessed) {
        p.quality = assess(extract_patch(cut_, faces_of(panel)));
        p.assessed = true;
    }
    return p.quality;
}

bool Layout::split(int panel, bool anyhow) {
    const std::vector<int> faces = faces_of(panel);
    const PanelPatch patch = extract_patch(cut_, faces);
    const SurfaceField field = field_on(faces);
    const auto found = anyhow ? plain_split(patch, field, rules_) : best_split(patch, field, rules_);
    if (!found) return false;
    Curve curve = found->curve;
    for (CurvePoint& p : curve) {
        p.a = patch.node[p.a];
        if (p.b >= 0) p.b = patch.node[p.b];
    }
    cut_.insert_seam(curve);
    relabel(panel);
    return true;
}

int Layout::worst_panel() {
    int worst = -1;
    double most = 0;
    for (int p = 0; p < static_cast<int>(panels_.size()); ++p) {
        if (!panels_[p].alive || panels_[p].stuck) continue;
        const PanelQuality& q = quality(p);
        if (q.is_disk && q.p95 <= rules_.max_distortion) continue;
        if (!q.is_disk) return p;
        if (q.p95 > most) {
            most = q.p95;
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

bool Layout::try_merge(int a, int b, const std::vector<std::pair<int, int>>& edges) {
    for (const auto& [i, j] : edges) cut_.unmark_seam(i, j);
    std::vector<int> faces = faces_of(a);
    if (a != b) {
        const std::vector<int> more = faces_of(b);
        faces.insert(faces.end(), more.begin(), more.end());
        std::sort(faces.begin(), faces.end());
    }
    const PanelPatch patch = extract_patch(cut_, faces);
    bool ok = patch.is_disk() && static_cast<int>(corner_nodes(patch).size()) <= rules_.max_corners;
    PanelQuality q;
    if (ok) {
        q = assess(patch);
        ok = q.p95 <= std::max(rules_.max_distortion, a == b ? quality(a).p95 : 0.);
    }
    if (!ok) {
        for (const auto& [i, j] : edges) cut_.mark_seam(i, j);
        return false;
    }
    for (int f : faces) panel_[f] = a;
    if (a != b) panels_[b].alive = false;
    panels_[a] = {true, true, false, q};
    return true;
}

bool Layout::prune() {
    std::map<std::pair<int, int>, bool> failed;
    bool any = false;
    for (bool merged = true; merged;) {
        merged = false;
        std::map<std::pair<int, int>, std::pair<double, std::vector<std::pair<int, int>>>> borders;
        const Surface& s = cut_.surface();
        for (int f = 0; f < s.n_faces(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int i = s.faces[f][k], j = s.faces[f][(k + 1) % 3];
                if (i > j || !cut_.is_seam(i, j)) continue;
                const int g = cut_.face_left(j, i);
                auto& border = borders[std::minmax(panel_[f], panel_[g])];
                border.first += (s.x[i] - s.x[j]).norm();
                border.second.emplace_back(i, j);
            }
        std::vector<std::pair<double, std::pair<int, int>>> order;
        for (const auto& [pair, border] : borders) order.emplace_back(-border.first, pair);
        std::sort(order.begin(), order.end());
        for (const auto& [length, pair] : order) {
            if (failed.count(pair)) continue;
            if (try_merge(pair.first, pair.second, borders[pair].second)) {
                merged = any = true;
                std::erase_if(failed, [&](const auto& item) {
                    return item.first.first == pair.first || item.first.second == pair.first ||
                           item.first.first == pair.second || item.first.second == pair.second;
                });
                break;
            }
            failed[pair] = true;
        }
    }
    return any;
}

void Layout::search() {
    for (int round = 0; round < 3; ++round) {
        refine();
        if (!prune() || worst_panel() < 0) break;
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
