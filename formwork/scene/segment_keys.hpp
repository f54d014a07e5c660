#pragma once

#include <optional>
#include <string>

#include "formwork/segment/direction_data.hpp"
#include "formwork/segment/segment.hpp"
#include "formwork/segment/spectral_split.hpp"

namespace formwork {

/// Keys of `formwork.segment`: where the directions come from, and what the layout does with them.
struct SegmentKeys {
    std::optional<arcsim::InputFile> field;   // null: from the inflated strain
    DirectionParams directions;
    SegmentParams layout;
    double max_covariance_energy = 0;   // (15); 0: the flattening alone decides
    SplitParams split;

    void set_threads(int n) { layout.threads = n; }
};
template <class Archive>
void visit(Archive& a, SegmentKeys& p) {
    a.optional("field", p.field,
               "File of directions, one line per face: theta s1 s2 [weight], theta from the edge between the first two "
               "corners, counter-clockwise about the normal, rad. null: from the inflated strain.");
    visit(a, p.directions);
    visit(a, p.layout);
    a.optional("max_covariance_energy", p.max_covariance_energy, "", arcsim::non_negative,
               "Energy (15) above which a panel of the layout counts as too far from developable and is split; a dome "
               "stretches by about a 29th of it. 0: the measured stretch of the flat panels alone decides.");
    visit(a, p.split);
}

}  // namespace formwork
