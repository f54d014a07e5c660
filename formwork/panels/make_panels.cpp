#include <algorithm>
#include <cmath>
#include <string>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/panels/compensation.hpp"
#include "formwork/panels/cut_panels.hpp"
#include "formwork/panels/grain.hpp"
#include "formwork/panels/notches.hpp"
#include "formwork/panels/panel_set.hpp"
#include "formwork/panels/seam_match.hpp"

namespace formwork {
namespace {

std::string percent(double share) { return arcsim::format_short(100 * share, 3) + " %"; }

void measure_panel(const std::vector<Matrix2d>& shapes, FlatPanel& panel) {
    const StretchStatistics stretch = measure_stretch(panel.faces, shapes, panel.u);
    panel.face_distortion = face_distortions(panel.faces, shapes, panel.u);
    panel.area = 0;
    for (const Triangle& t : panel.faces) {
        const Vector2d a = panel.u[t[1]] - panel.u[t[0]], b = panel.u[t[2]] - panel.u[t[0]];
        panel.area += (a.x() * b.y() - a.y() * b.x()) / 2;
    }
    panel.mean_stretch_distortion = stretch.mean;
    panel.p95_stretch_distortion = stretch.p95;
    panel.max_stretch_distortion = stretch.max;
    panel.symmetric_dirichlet = stretch.symmetric_dirichlet;
    panel.flips = stretch.flips;
    std::vector<Vector2d> outline;
    for (int i : panel.boundary) outline.push_back(panel.u[i]);
    panel.overlaps = !outline_crossings(outline).empty();
}

/// The lower left corner of the panel's box becomes the origin.
void move_to_origin(FlatPanel& panel) {
    Vector2d low = panel.u.front();
    for (const Vector2d& p : panel.u) low = low.cwiseMin(p);
    for (Vector2d& p : panel.u) p -= low;
}

void check_panel(const FlatPanel& panel, const PanelParams& params) {
    const std::string who = "panels: panel " + std::to_string(panel.id + 1);
    constexpr const char* finer = "Allow more panels (/formwork/segment/max_panels), narrower ones (/formwork/segment/min_width) or less distortion per panel "
                                  "(/formwork/segment/max_distortion)";
    if (panel.flips > 0) throw arcsim::NumericalError(who + ": " + std::to_string(panel.flips) + " faces turned over while flattening.");
    if (panel.p95_stretch_distortion > params.max_distortion)
        throw arcsim::NumericalError(who + " cannot be laid flat: 5 % of its area would stretch or shrink by more than " +
                                 percent(panel.p95_stretch_distortion) + ", allowed are " + percent(params.max_distortion) + ". " +
                                 finer + ", or raise /formwork/panels/max_distortion.");
    if (panel.overlaps) throw arcsim::NumericalError(who + " overlaps itself when laid flat and cannot be cut from one sheet. " + finer + ".");
}

void check_seam(const PanelSet& set, std::size_t i) {
    const PanelSeam& seam = set.seams[i];
    if (seam.local_mismatch <= set.params.max_seam_mismatch && seam.mismatch <= set.params.max_seam_mismatch) return;
    throw arcsim::InputError("panels: seam " + seam_name(set, static_cast<int>(i)) + " between panels " +
                             std::to_string(seam.side[0].panel + 1) + " and " + std::to_string(seam.side[1].panel + 1) +
                             ": its sides differ by " + percent(std::max(seam.local_mismatch, seam.mismatch)) + ", allowed are " +
                             percent(set.params.max_seam_mismatch) +
                             ". Allow more panels (/formwork/segment/max_panels), or raise /formwork/panels/max_seam_mismatch.");
}

PanelMetrics measure_set(const PanelSet& set) {
    PanelMetrics m;
    m.count = static_cast<int>(set.panels.size());
    for (const FlatPanel& panel : set.panels) {
        m.cloth_area_m2 += panel.area;
        m.rest_area_m2 += panel.rest_area;
        m.mean_stretch_distortion += panel.rest_area * panel.mean_stretch_distortion;
        m.max_stretch_distortion = std::max(m.max_stretch_distortion, panel.max_stretch_distortion);
        m.flips += panel.flips;
        m.overlaps += panel.overlaps;
    }
    if (m.rest_area_m2 > 0) m.mean_stretch_distortion /= m.rest_area_m2;
    for (const PanelSeam& seam : set.seams)
        m.max_seam_length_mismatch = std::max({m.max_seam_length_mismatch, seam.mismatch, seam.local_mismatch});
    return m;
}

}  // namespace

PanelSet make_panels(const Segmentation& s, const PanelParams& params) {
    PanelSet set;
    set.params = params;
    cut_panels(s, set);

    if (params.stretch_compensation && s.direction.empty())
        throw arcsim::InputError("panels: /formwork/panels/stretch_compensation needs the simulated stretch of every face. Run inflate first.");
    const bool shrinks = params.compensation[0] != 0 || params.compensation[1] != 0;
    std::vector<std::vector<Matrix2d>> shapes, surface_shapes;
    for (FlatPanel& panel : set.panels) {
        const Surface surface = panel_surface(s, panel);
        panel.rest_area = arcsim::total_area(surface);
        panel.u = flatten_disk(surface, {200, 1e-4}).u;   // the joint solve goes on from here
        surface_shapes.push_back(rest_shapes(surface));
        shapes.push_back(surface_shapes.back());
        if (params.stretch_compensation) relax_stretch(s, panel, shapes.back());
        turn_to_grain(s, surface_shapes.back(), params.warp, panel);
        if (shrinks) shrink_to_weave(params.compensation, panel, shapes.back());
    }
    constexpr int rounds = 3;   // the second one, seldom needed, places notches on seams that match already
    for (int round = 0; round < rounds; ++round) {
        place_notches(set, s);
        match_seams(set, s, shapes);
        measure_seams(set, s);
        if (!notches_too_far_apart(set)) break;
    }
    for (std::size_t p = 0; p < set.panels.size(); ++p) {
        move_to_origin(set.panels[p]);
        measure_grain(s, surface_shapes[p], set.panels[p]);
        measure_panel(shapes[p], set.panels[p]);
        check_panel(set.panels[p], params);
    }
    for (std::size_t i = 0; i < set.seams.size(); ++i) check_seam(set, i);
    set.metrics = measure_set(set);
    return set;
}

void measure_panels(PanelSet& set, const Segmentation& s) {
    for (FlatPanel& panel : set.panels) {
        const Surface surface = panel_surface(s, panel);
        const std::vector<Matrix2d> shapes = rest_shapes(surface);
        panel.rest_area = arcsim::total_area(surface);
        measure_grain(s, shapes, panel);
        measure_panel(shapes, panel);
    }
    measure_seams(set, s);
    set.metrics = measure_set(set);
}

std::vector<Vector2d> flat_chain(const PanelSet& set, const SeamSide& side) {
    std::vector<Vector2d> chain;
    for (int v : side.vertex) chain.push_back(set.panels[side.panel].u[v]);
    return chain;
}

std::string panel_name(int panel) { return (panel < 9 ? "P0" : "P") + std::to_string(panel + 1); }

std::string seam_name(const PanelSet& set, int seam) {
    return (set.seams[seam].is_rim() ? "R" : "S") + std::string(seam < 9 ? "0" : "") + std::to_string(seam + 1);
}

}  // namespace formwork
