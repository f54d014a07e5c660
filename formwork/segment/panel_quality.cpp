#include "formwork/segment/panel_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "arcsim/base/error.hpp"

namespace formwork {
namespace {

constexpr double worth_of_folds = 2.5;   // times the allowed stretch, at least, is what a panel counts as that cannot be laid flat without folds
constexpr double least_calibration = 0.4;
constexpr double usual_calibration = 0.75;   // measured stretch over estimate, typical of panels of mixed shape
constexpr int estimate_cells = 400;

PanelMemory::Flat lay_flat(const PanelPatch& patch, const FlattenParams& params, double min_width) {
    try {
        const FlattenResult flat = flatten_disk(patch.surface, patch.topology.boundary_loops.front(), params);
        std::vector<Vector2d> outline;
        for (int v : patch.topology.boundary_loops.front()) outline.push_back(flat.u[v]);
        return {.p95 = flat.stretch.p95, .solidity = solidity(outline), .overlaps = !outline_crossings(outline, 1).empty(),
                .gaps = outline_gaps(outline, min_width)};
    } catch (const arcsim::NumericalError&) {
        return {.failed = true};
    } catch (const arcsim::InputError&) {   // a face that cutting left without area: the search goes on, repair may mend it
        return {.failed = true};
    }
}

}  // namespace

PanelQuality look_at(const PanelPatch& patch, const SplitRules& rules, double calibration) {
    PanelQuality q;
    q.is_disk = patch.is_disk();
    for (int f = 0; f < patch.surface.n_faces(); ++f) {
        const double a = arcsim::face_area(patch.surface, f);
        q.area += a;
        q.centre += a * arcsim::face_centroid(patch.surface, f);
    }
    q.centre /= q.area;
    q.p95 = std::numeric_limits<double>::infinity();
    if (!q.is_disk) return q;
    q.width = patch_width(patch);
    q.shape = outline_shape(patch, rules.min_width, rules.care);
    q.corners = q.shape.corners;
    const auto [known, is_new] = rules.memory->estimate.try_emplace(PanelMemory::key_of(patch.surface));
    if (is_new) known->second = StretchModel(patch, estimate_cells).whole().p95;
    q.estimate = known->second;
    q.p95 = calibration * q.estimate;
    return q;
}

void measure_flat(const PanelPatch& patch, const SplitRules& rules, PanelQuality& q) {
    if (!q.is_disk || q.is_flattened || q.p95 > rules.believed * rules.max_distortion) return;
    q.is_flattened = true;
    const auto [known, is_new] =
        rules.memory->flat.try_emplace(PanelMemory::key_of(patch.surface) + static_cast<PanelMemory::Key>(rules.flattening.max_iterations));
    if (is_new) {
        known->second = lay_flat(patch, rules.flattening, rules.min_width);
        rules.effort->spent += patch.surface.n_faces();
    }
    const PanelMemory::Flat& flat = known->second;
    q.has_failed = flat.failed;
    q.p95 = flat.failed ? std::max(q.estimate, worth_of_folds * rules.max_distortion) : flat.p95;
    q.solidity = flat.solidity;
    q.overlaps = flat.overlaps || flat.gaps.inlet < rules.clearance;
    q.shape.sharpest = std::min(q.shape.sharpest, 2 * std::asin(flat.gaps.neck));
}

double calibration_of(const PanelQuality& q) {
    return q.is_flattened && q.estimate > 0 ? std::clamp(q.p95 / q.estimate, least_calibration, 1.3) : usual_calibration;
}

double excess_of(const PanelQuality& q, const SplitRules& rules) {
    if (!q.is_disk) return 10 * q.area;
    return q.area * (std::max(0., q.p95 / rules.max_distortion - 1) + q.overlaps + 0.2 * std::max(0, q.corners - rules.max_corners));
}

bool keeps_bounds(const PanelQuality& q, const SplitRules& rules) {
    return q.is_disk && !q.overlaps && q.p95 <= rules.max_distortion && q.corners <= rules.max_corners && q.width >= rules.min_width;
}

PanelQuality at_best(PanelQuality q) {
    if (q.is_disk && !q.is_flattened) q.p95 = least_calibration * q.estimate;
    return q;
}

double panel_cost(const PanelQuality& q, const SplitRules& rules) {
    constexpr double violation = 10, most_excess = 10, tip = 1.2, least_tip = 0.5 /* rad */, inner_corner = 0.6, hook = 10;
    if (!q.is_disk) return 10 * violation;
    double cost = 1;
    if (q.p95 > rules.max_distortion) cost += violation + violation * std::min(most_excess, q.p95 / rules.max_distortion - 1);
    if (q.overlaps) cost += violation;
    if (q.corners > rules.max_corners) cost += violation;
    if (q.width < rules.min_width) cost += violation;
    if (q.shape.sharpest < least_tip) cost += tip * (2 - q.shape.sharpest / least_tip);
    cost += hook * std::max(0., least_solidity - q.solidity);
    return cost + inner_corner * q.shape.inner_corners;
}

}  // namespace formwork
