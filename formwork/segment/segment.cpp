#include "formwork/segment/segment.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "arcsim/base/error.hpp"
#include "formwork/segment/layout.hpp"
#include "formwork/segment/mesh_repair.hpp"
#include "formwork/segment/mirror_layout.hpp"
#include "formwork/segment/seam_chains.hpp"
#include "formwork/segment/strokes.hpp"
#include "formwork/segment/surface_curve.hpp"

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

struct Job {
    const Surface& s;
    const Topology& topology;
    const std::vector<DirectionData>& data;
    const SegmentParams& params;
    const CrossField& field;
    std::vector<Stroke> strokes;
    SplitRules rules;

    Layout layout(int max_panels) const { return {s, field.theta, data, rules, {max_panels}}; }
};

/// The layout's cut mesh, mended, with everything that the next stages ask for.
Segmentation finish(const Job& job, Layout& layout) {
    Segmentation r;
    r.field = job.field;
    r.singularities = find_singularities(job.s, job.topology, job.field);
    const CutMesh& before = layout.cut();
    std::vector<int> singular;
    for (Singularity& q : r.singularities) {   // a mirrored half has nodes of its own: the nearest takes the singularity
        const Vector3d x = job.s.x[q.node];
        if (q.node >= before.surface().n_nodes() || before.surface().x[q.node] != x) {
            double least = std::numeric_limits<double>::infinity();
            for (int v = 0; v < before.surface().n_nodes(); ++v) {
                const double d = (before.surface().x[v] - x).squaredNorm();
                if (d < least) {
                    least = d;
                    q.node = v;
                }
            }
        }
        singular.push_back(q.node);
    }
    RepairedMesh mesh = repair_mesh(before, job.s, job.topology, singular);
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

Segmentation free_layout(const Job& job) {
    Layout layout = job.layout(job.params.max_panels);
    for (std::size_t i = 0; i < job.strokes.size(); ++i)
        if (!layout.add_curve(stroke_curve(layout, job.strokes[i], static_cast<int>(i)), true))
            throw arcsim::InputError("segment: stroke " + std::to_string(i + 1) + " crosses itself. Draw it as several strokes.");
    layout.search();
    return finish(job, layout);
}

/// One half's layout and its mirror image; nothing when the halves do not fit.
std::optional<Segmentation> mirrored_layout(const Job& job, const MirrorPlane& plane) {
    std::vector<SurfacePoint> source;
    const Surface settled = settle_on_plane(job.s, job.topology, plane.point, plane.normal, source);
    std::vector<int> same(settled.faces.size());
    std::iota(same.begin(), same.end(), 0);
    Layout half(job.s, job.field.theta, job.data, job.rules, {std::max(1, job.params.max_panels / 2)},
                CutMesh(job.s, settled, std::move(source), std::move(same)));
    for (Curve& curve : plane_curves(settled, job.topology, plane.point, plane.normal)) {
        snap_curve(job.topology, curve, 0.1);
        if (curve.size() < 3) return {};
        if (!half.add_curve(curve, false)) return {};
    }
    half.keep_one_side(plane.point, plane.normal);
    half.search();
    MirroredMesh whole = mirror_half(half.cut(), half.kept_faces(), job.s, job.topology, plane);
    if (!whole.is_sound) return {};
    CutMesh cut(job.s, std::move(whole.surface), std::move(whole.source), std::move(whole.source_face));
    for (const auto& [a, b] : whole.seams) cut.mark_seam(a, b);
    Layout layout(job.s, job.field.theta, job.data, job.rules, {job.params.max_panels}, std::move(cut));
    layout.merge_images(whole.face_image);
    return finish(job, layout);
}

}  // namespace

Segmentation segment(const Surface& s, const std::vector<DirectionData>& data, const SegmentParams& params) {
    const Topology topology = arcsim::build_topology(s, "segment");
    check_input(s, topology, data);
    std::vector<Stroke> strokes;
    if (!params.constraints.strokes.path.empty()) strokes = read_strokes(params.constraints.strokes.path.string());
    FieldParams wanted = params.field;
    const auto hard = hard_directions(s, topology, params.constraints, strokes);
    wanted.hard.insert(wanted.hard.end(), hard.begin(), hard.end());
    const CrossField field = smooth_cross_field(s, topology, data, wanted);
    Job job{s, topology, data, params, field, strokes, {}};
    job.rules.drift = {params.drift_penalty, params.max_angle_deg * std::numbers::pi / 180};
    job.rules.min_width = params.min_width;
    job.rules.max_distortion = params.max_distortion;
    std::optional<Segmentation> mirrored;
    if (params.symmetry == Symmetry::detect && strokes.empty() && params.max_panels > 1) {
        const auto planes = find_mirror_planes(s, topology);
        if (!planes.empty() && planes[0].deviation < 0.25 * arcsim::mean_edge_length(s))
            mirrored = mirrored_layout(job, planes[0]);
        if (mirrored && mirrored->violations.empty() && mirrored->n_panels > 1) return *mirrored;
    }
    Segmentation free = free_layout(job);
    if (mirrored && mirrored->violations.size() <= free.violations.size() && mirrored->n_panels <= 2 * free.n_panels)
        return *mirrored;
    return free;
}

}  // namespace formwork
