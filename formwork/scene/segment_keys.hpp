#pragma once

#include <optional>
#include <string>

#include "formwork/segment/direction_data.hpp"
#include "formwork/segment/segment.hpp"

namespace formwork {

/// Keys of `formwork.segment`: where the directions come from, and what the layout does with them.
struct SegmentKeys {
    std::optional<arcsim::InputFile> field;   // null: from the inflated strain
    DirectionParams directions;
    SegmentParams layout;

    void set_threads(int n) { layout.threads = n; }
};
template <class Archive>
void visit(Archive& a, SegmentKeys& p) {
    a.optional("field", p.field,
               "File of directions, one line per face: theta s1 s2 [weight], theta from the edge between the first two "
               "corners, counter-clockwise about the normal, rad. null: from the inflated strain.");
    visit(a, p.directions);
    visit(a, p.layout);
}

}  // namespace formwork
