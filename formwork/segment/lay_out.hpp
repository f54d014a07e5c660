#pragma once

#include <vector>

#include "formwork/segment/layout.hpp"
#include "formwork/segment/segment.hpp"
#include "formwork/segment/strokes.hpp"

namespace formwork {

/// One surface with its smoothed field, to be laid out in panels.
struct LayoutJob {
    const Surface& s;
    const Topology& topology;
    const std::vector<DirectionData>& data;
    const SegmentParams& params;
    const CrossField& field;
    std::vector<Singularity> singularities;   // of the field, by nodes of s
    std::vector<Stroke> strokes;
    SplitRules rules;
};

/// What the keys ask of a cut.
SplitRules split_rules(const SegmentParams& params);

/// The panels: searched on a coarser mesh when the surface has many faces, one part mirrored when it has mirror planes;
/// the seams are then cut into the surface itself, straightened, and thin faces along them mended. The bounds are
/// judged on what is handed over.
Segmentation lay_out(const LayoutJob& job);

/// The last step of it alone, for a mesh that was cut elsewhere: no seam is added or taken away.
Segmentation mend_and_hand_over(const LayoutJob& job, const CutMesh& cut, std::vector<CandidateCurve> candidates);

}  // namespace formwork
