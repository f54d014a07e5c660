#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "arcsim/base/archive.hpp"
#include "formwork/segment/field_constraints.hpp"
#include "formwork/segment/segmentation.hpp"

namespace formwork {

/// Whether the layout keeps a mirror plane of the surface.
enum class Symmetry { detect, off };

inline constexpr std::array symmetry_names{
    arcsim::EnumName{Symmetry::detect, "detect", "a mirror plane of the surface becomes a seam, and one half's layout is mirrored; "
                                                 "given up when that breaks bounds which a free layout keeps"},
    arcsim::EnumName{Symmetry::off, "off", "free layout"}};

/// Keys of the scene's `segment` block that the layout reads; the field's are FieldParams.
struct SegmentParams {
    FieldParams field;
    double drift_penalty = 5;      // alpha of (13)
    double max_angle_deg = 45;     // theta_max of (13)
    int max_panels = 24;
    double max_distortion = 0.05;
    double min_width = 0.03;       // m
    double layout_effort = 1;
    Symmetry symmetry = Symmetry::detect;
    ConstraintParams constraints;  // strokes are seams too, and never removed
    int threads = 0;
    std::function<void(std::string_view)> on_step;   // no key: told what stands during the search; may throw Interrupted
};

template <class Archive>
void visit(Archive& a, SegmentParams& p) {
    visit(a, p.field);
    a.optional("drift_penalty", p.drift_penalty, "", arcsim::non_negative,
               "alpha of (13): how much dearer a seam becomes where it drifts from the field.");
    a.optional("max_angle_deg", p.max_angle_deg, "degrees", arcsim::between(5, 90),
               "theta_max of (13): seams never drift further from the field within one step.");
    a.optional("max_panels", p.max_panels, "", arcsim::at_least(1), "Largest number of panels.");
    a.optional("max_distortion", p.max_distortion, "", arcsim::between(0.001, 1),
               "Stretch |sigma - 1| between flat pattern and surface that 95 % of every panel's area stays below.");
    a.optional("min_width", p.min_width, "m", arcsim::non_negative,
               "Diameter of the largest disk that every panel must hold.");
    a.optional("layout_effort", p.layout_effort, "", arcsim::between(0.1, 100),
               "Work that the search for panels may do, times the usual, which takes some 4 s at 20 000 faces; many panels gain by more.");
    a.choice("symmetry", p.symmetry, symmetry_names, "What to do with mirror planes of the surface.");
    visit(a, p.constraints);
}

/// Cuts the surface into panels that can be laid flat and sewn: the cross field of (12), curves along it by
/// (13), and of these the few that are needed (class Layout).
/// @param data  one per face
/// @returns a Segmentation whose `violations` name every bound that could not be met
/// @throws InputError   surface of several components, non-manifold, degenerate or with unused nodes; data of
///                      the wrong length or not finite
/// @throws NumericalError   the field's factorisation failed, or no cut makes a panel a disk
Segmentation segment(const Surface& s, const std::vector<DirectionData>& data, const SegmentParams& params);

/// What `segment` asks of its input, without the work.
/// @throws InputError   as `segment`
void check_segment_input(const Surface& s, const std::vector<DirectionData>& data, const SegmentParams& params);

}  // namespace formwork
