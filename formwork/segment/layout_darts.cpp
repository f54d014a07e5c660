// Darts, for panels that no seam between two panels helps: a tip, a cone, the end of an ear.

#include <limits>

#include "formwork/segment/cut_pieces.hpp"
#include "formwork/segment/dart.hpp"
#include "formwork/segment/layout.hpp"

namespace formwork {

bool Layout::add_dart(int panel) {
    constexpr double worth = 0.5;   // of the excess must go: a dart is work, too
    const PanelPatch patch = extract_patch(cut_, faces_of(panel));
    const PanelQuality before = quality(panel);
    double least = worth * excess(before);
    const Curve* best = nullptr;
    const std::vector<Curve> darts = dart_curves(patch, field_on(patch), rules_);
    for (const Curve& dart : darts) {
        const auto pieces = split_pieces(patch, dart);
        if (pieces.size() != 1) continue;
        PanelQuality after = look_at(pieces.front(), rules_, calibration_of(before));
        formwork::measure_flat(pieces.front(), rules_, after);
        if (!after.is_disk || !after.is_flattened || after.corners > std::max(before.corners, rules_.max_corners) || excess(after) >= least) continue;
        least = excess(after);
        best = &dart;
    }
    if (!best) return false;
    const bool done = !cut_.insert_seam(on_cut(patch, *best)).empty();
    relabel(panel);
    return done;
}

bool Layout::add_darts() {
    bool any = false;
    for (int p = 0; p < static_cast<int>(panels_.size()); ++p) {
        if (!panels_[p].alive || panels_[p].frozen) continue;
        const PanelQuality& q = quality(p);
        if (q.is_disk && q.p95 > rules_.max_distortion) any |= add_dart(p);
    }
    return any;
}

}  // namespace formwork
