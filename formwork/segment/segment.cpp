#include "formwork/segment/segment.hpp"

#include <cmath>

#include "arcsim/base/error.hpp"
#include "formwork/segment/lay_out.hpp"

namespace formwork {
namespace {

void check_input(const Surface& s, const Topology& t, const std::vector<DirectionData>& data) {
    using arcsim::InputError;
    if (s.n_faces() == 0) throw InputError("segment: the mesh has no faces. Give a triangle mesh.");
    for (int v = 0; v < s.n_nodes(); ++v)
        if (t.component[v] < 0)
            throw InputError("segment: node " + std::to_string(v + 1) +
                             " belongs to no face. Remove unreferenced vertices from the mesh.");
    if (t.n_components > 1)
        throw InputError("segment: the mesh has " + std::to_string(t.n_components) +
                         " components. Give one connected surface per scene.");
    const double mean = arcsim::total_area(s) / s.n_faces();
    for (int f = 0; f < s.n_faces(); ++f)
        if (!(arcsim::face_area(s, f) > 1e-12 * mean))
            throw InputError("segment: face " + std::to_string(f + 1) + " has no area. Remove or merge degenerate faces.");
    if (data.size() != s.faces.size())
        throw InputError("segment: the direction field has " + std::to_string(data.size()) + " entries, the mesh " +
                         std::to_string(s.n_faces()) + " faces. Give one line per face.");
    for (std::size_t f = 0; f < data.size(); ++f)
        if (!std::isfinite(data[f].theta) || !std::isfinite(data[f].s1) || !std::isfinite(data[f].s2) ||
            !std::isfinite(data[f].weight))
            throw InputError("segment: the direction of face " + std::to_string(f + 1) +
                             " is not a number. Mend the field, or give the face the weight 0.");
}

std::vector<Stroke> strokes_of(const SegmentParams& params) {
    return params.constraints.strokes.path.empty() ? std::vector<Stroke>{} : read_strokes(params.constraints.strokes.path.string());
}

}  // namespace

void check_segment_input(const Surface& s, const std::vector<DirectionData>& data, const SegmentParams& params) {
    const Topology topology = arcsim::build_topology(s, "segment");
    check_input(s, topology, data);
    hard_directions(s, topology, params.constraints, strokes_of(params));
}

Segmentation segment(const Surface& s, const std::vector<DirectionData>& data, const SegmentParams& params) {
    const Topology topology = arcsim::build_topology(s, "segment");
    check_input(s, topology, data);
    std::vector<Stroke> strokes = strokes_of(params);
    FieldParams wanted = params.field;
    const auto hard = hard_directions(s, topology, params.constraints, strokes);
    wanted.hard.insert(wanted.hard.end(), hard.begin(), hard.end());
    const CrossField field = smooth_cross_field(s, topology, data, wanted);
    return lay_out({s, topology, data, params, field, find_singularities(s, topology, field), std::move(strokes), split_rules(params)});
}

}  // namespace formwork
