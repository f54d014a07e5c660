#include "formwork/segment/segment.hpp"

#include <cmath>
#include <numbers>

#include "arcsim/base/error.hpp"
#include "formwork/segment/layout.hpp"
#include "formwork/segment/mesh_repair.hpp"
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

/// The layout's cut mesh, mended, with everything that the next stages ask for.
Segmentation finish(const Surface& s, const Topology& topology, const CrossField& field, Layout& layout) {
    Segmentation r;
    r.singularities = find_singularities(s, topology, field);
    std::vector<int> singular;
    for (const Singularity& q : r.singularities) singular.push_back(q.node);   // input nodes keep their numbers
    RepairedMesh mesh = repair_mesh(layout.cut(), s, topology, singular);
    for (Singularity& q : r.singularities) q.node = mesh.node[q.node];
    r.mesh = std::move(mesh.surface);
    r.source = std::move(mesh.source);
    r.source_face = std::move(mesh.source_face);
    CutMesh cut(r.mesh);
    for (const auto& [a, b] : mesh.seams) cut.mark_seam(a, b);
    r.panel = label_panels(cut, r.n_panels);
    r.seams = collect_seams(cut, r.panel);
    SurfaceField on_cut = layout.field_on(r.mesh, r.source_face);
    r.field_theta = std::move(on_cut.theta);
    r.direction = std::move(on_cut.data);
    r.violations = layout.violations();
    return r;
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

    return finish(s, topology, field, layout);
}

}  // namespace formwork
