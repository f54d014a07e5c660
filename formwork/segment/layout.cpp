#include "formwork/segment/layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "arcsim/base/text.hpp"

namespace formwork {
namespace {

/// Both in per cent, with as many digits as tell them apart.
std::string excess_message(double stretch, double bound) {
    int digits = 3;
    const auto percent = [&](double v) { return arcsim::format_short(100 * v, digits) + " %"; };
    while (digits < 16 && percent(stretch) == percent(bound)) ++digits;
    return "stretch of " + percent(stretch) + " (95 % of the area) exceeds max_distortion " + percent(bound);
}

}  // namespace

Layout::Layout(const Surface& input, const std::vector<double>& theta, const std::vector<DirectionData>& data,
               const SplitRules& rules, const LayoutLimits& limits)
    : Layout(input, theta, data, rules, limits, CutMesh(input)) {}

Layout::Layout(const Surface& input, const std::vector<double>& theta, const std::vector<DirectionData>& data,
               const SplitRules& rules, const LayoutLimits& limits, CutMesh cut)
    : input_(&input), rules_(rules), limits_(limits), cut_(std::move(cut)), data_(&data) {
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
        field.data.push_back((*data_)[source_face[f]]);
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
            const int f = stack.back();
            stack.pop_back();
            for (int k = 0; k < 3; ++k) {
                const int g = cut_.across(f, k);
                if (g < 0 || panel_[g] >= 0 || cut_.is_seam_at(f, k)) continue;
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
    for (std::size_t p = 0; p < panels_.size(); ++p) panels_[p].frozen = panels_[p].frozen || side[p] < 0;
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

const PanelQuality& Layout::look(int panel) {
    Panel& p = panels_[panel];
    if (!p.looked_at) {
        const PanelPatch patch = extract_patch(cut_, faces_of(panel));
        p.quality = look_at(patch, rules_, calibration_of({}));
        p.looked_at = true;
    }
    return p.quality;
}

const PanelQuality& Layout::quality(int panel) {
    look(panel);
    Panel& p = panels_[panel];
    if (!p.assessed) {
        const PanelPatch patch = extract_patch(cut_, faces_of(panel));
        formwork::measure_flat(patch, rules_, p.quality);
        p.assessed = true;
        tell();
    }
    return p.quality;
}

void Layout::tell() const {
    if (!limits_.on_step) return;
    double worst = 0;
    for (const Panel& p : panels_)
        if (p.alive && p.assessed && !p.frozen && std::isfinite(p.quality.p95)) worst = std::max(worst, p.quality.p95);
    const int n = n_panels();
    limits_.on_step(std::to_string(n) + (n == 1 ? " panel" : " panels") + ", worst " + std::to_string(std::lround(100 * worst)) + " %");
}

std::vector<std::string> Layout::violations() {
    std::vector<std::string> lines;
    int n = 0;
    const std::vector<int> number = label_panels(cut_, n);
    std::vector<char> told(panels_.size(), 0);
    for (std::size_t f = 0; f < panel_.size(); ++f) {
        const int p = panel_[f];
        if (told[p]) continue;
        told[p] = 1;
        const PanelQuality& q = quality(p);
        const std::string name = "panel " + std::to_string(number[f] + 1) + ": ";
        if (!q.is_disk) lines.push_back(name + "is no disk");
        if (q.has_failed)
            lines.push_back(name + "cannot be laid flat without folds");
        else if (q.is_disk && q.p95 > rules_.max_distortion)
            lines.push_back(name + excess_message(q.p95, rules_.max_distortion));
        if (q.overlaps) lines.push_back(name + "overlaps itself when laid flat");
        if (q.corners > rules_.max_corners)
            lines.push_back(name + std::to_string(q.corners) + " corners, more than " + std::to_string(rules_.max_corners));
        if (q.is_disk && q.width < rules_.min_width) lines.push_back(name + "narrower than min_width");
    }
    if (n > limits_.max_panels)
        lines.push_back("layout: " + std::to_string(n) + " panels, more than max_panels " + std::to_string(limits_.max_panels));
    return lines;
}

}  // namespace formwork
