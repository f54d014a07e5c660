#include "formwork/segment/segment.hpp"

#include <cmath>
#include <numbers>

#include "arcsim/base/error.hpp"
#include "formwork/segment/layout.hpp"
#include "formwork/segment/seam_chains.hpp"

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

}  // namespace

Segmentation segment(const Surface& s, const std::vector<DirectionData>& data, const SegmentParams& params) {
    const Topology topology = arcsim::build_topology(s, "segment");
    check_input(s, topology, data);
    const CrossField field = smooth_cross_field(s, topology, data, params.field);
    SplitRules rules;
    rules.drift = {params.drift_penalty, params.max_angle_deg * std::numbers::pi / 180};
    rules.min_width = params.min_width;
    rules.max_distortion = params.max_distortion;
    Layout layout(s, field.theta, data, rules, {params.max_panels});
    layout.search();

    Segmentation result;
    const CutMesh& cut = layout.cut();
    result.mesh = cut.surface();
    result.source = cut.source();
    result.source_face = cut.source_face();
    result.panel = label_panels(cut, result.n_panels);
    result.seams = collect_seams(cut, result.panel);
    std::vector<int> all(result.mesh.faces.size());
    for (std::size_t f = 0; f < all.size(); ++f) all[f] = static_cast<int>(f);
    SurfaceField on_cut = layout.field_on(all);
    result.field_theta = std::move(on_cut.theta);
    result.direction = std::move(on_cut.data);
    result.singularities = find_singularities(s, topology, field);   // input nodes keep their numbers
    for (const std::string& v : layout.violations()) result.violations.push_back(v);
    return result;
}

}  // namespace formwork
