#include "formwork/segment/lay_out.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "arcsim/base/error.hpp"
#include "formwork/segment/crease_seams.hpp"
#include "formwork/segment/degree.hpp"
#include "formwork/segment/mesh_repair.hpp"
#include "formwork/segment/mirror_layout.hpp"
#include "formwork/segment/seam_chains.hpp"
#include "formwork/segment/search_mesh.hpp"
#include "formwork/segment/surface_curve.hpp"

namespace formwork {
namespace {

constexpr int enough_faces = 6000;       // for a layout of few panels: more only cost time
constexpr int faces_per_panel = 100;
constexpr double least_work = 2.5e5;     // faces laid flat or searched for curves, see effort.hpp: 3 to 4 s
constexpr double work_per_face = 12.5;   // of the input, where that is more: the work grows like the mesh
constexpr double search_share = 0.7;     // of all work; the rest is for what mending the seams did
constexpr int repair_rounds = 3;
constexpr FlattenParams polishing{30, 1e-3};   // p95 is settled to a hundredth of itself
constexpr FlattenParams thorough{60, 1e-4};   // to a few thousandths
constexpr double margin = 0.93, polish_margin = 0.96;   // of the bound, in the search: what is done to the mesh later costs some

constexpr double corner_care = 0.9;       // corners that nearly count do once a seam is straightened
constexpr double least_clearance = 0.1;   // of min_width: pieces that nearly touch themselves do once they are laid flat more precisely

/// The mesh that the layout is searched on.
struct Base {
    MeshOnInput mesh;
    Topology topology;
    bool is_coarse = false;
    bool has_creases = false;   // that part the surface: they are tried as seams
    double work = 1;   // share of all work that one layout on it may take
};

Base whole_mesh(const LayoutJob& job) {
    std::vector<int> same(job.s.faces.size());
    std::iota(same.begin(), same.end(), 0);
    return {{job.s, CutMesh(job.s).source(), std::move(same)}, job.topology, false};
}

double crease_angle(const LayoutJob& job) { return job.params.constraints.crease_angle_deg * degree; }

bool has_creases(const LayoutJob& job) {
    if (crease_angle(job) <= 0) return false;
    CutMesh cut(job.s);
    return mark_crease_seams(cut, crease_angle(job), job.params.min_width);
}

/// Strokes and creases are followed edge by edge: they need the mesh as it is.
Base base_mesh(const LayoutJob& job) {
    const double per_panel = faces_per_panel * std::clamp(job.params.layout_effort, 1., 4.);   // with more work to do, finer panels pay
    const int target = std::max(enough_faces, static_cast<int>(per_panel * job.params.max_panels));
    const bool creases = has_creases(job);
    if (2 * job.s.n_faces() < 3 * target || !job.strokes.empty() || creases) {
        Base base = whole_mesh(job);
        base.has_creases = creases;
        return base;
    }
    SearchMesh coarse = search_mesh(job.s, job.topology, target);
    Topology topology = arcsim::build_topology(coarse.surface, "segment");
    return {{std::move(coarse.surface), std::move(coarse.source), std::move(coarse.source_face)}, std::move(topology), true};
}

/// Strict by turns: while seams are looked for, while they are polished, and for the verdict.
enum class Stage { search, polish, verdict };

Layout layout_on(const LayoutJob& job, CutMesh cut, int max_panels, Stage stage) {
    SplitRules rules = job.rules;
    if (stage != Stage::search) rules.flattening = stage == Stage::polish ? polishing : thorough;
    if (stage == Stage::verdict) {
        rules.believed = std::numeric_limits<double>::infinity();   // what is told of a panel is measured
    } else {
        rules.max_distortion *= stage == Stage::search ? margin : polish_margin;
        rules.care = corner_care;
        rules.clearance = least_clearance * rules.min_width;
    }
    return {job.s, job.field.theta, job.data, rules, {max_panels, job.params.on_step}, std::move(cut)};
}

CutMesh uncut(const LayoutJob& job, const MeshOnInput& mesh) { return {job.s, mesh.surface, mesh.source, mesh.source_face}; }

/// The node of the mesh at each singularity of the input, or the one nearest to it where the mesh has nodes of its own.
std::vector<int> singular_nodes(const LayoutJob& job, const Surface& mesh) {
    std::vector<int> nodes;
    for (const Singularity& q : job.singularities) {
        const Vector3d x = job.s.x[q.node];
        const auto nearer = [&](const Vector3d& a, const Vector3d& b) { return (a - x).squaredNorm() < (b - x).squaredNorm(); };
        nodes.push_back(static_cast<int>(std::min_element(mesh.x.begin(), mesh.x.end(), nearer) - mesh.x.begin()));
    }
    return nodes;
}

/// The cut mesh with straight seams and without thin faces.
CutMesh mended(const LayoutJob& job, const CutMesh& cut, std::vector<int>& singular) {
    RepairedMesh mesh = repair_mesh(cut, job.s, job.topology, singular);
    for (int& v : singular) v = mesh.node[v];
    CutMesh whole(job.s, std::move(mesh.surface), std::move(mesh.source), std::move(mesh.source_face));
    for (std::size_t i = 0; i < mesh.seams.size(); ++i) whole.mark_seam(mesh.seams[i].first, mesh.seams[i].second, mesh.given[i]);
    return whole;
}

/// Mends and judges by turns: a straightened seam lies elsewhere by a part of an edge, and panels that no longer keep the
/// bounds after that are laid out anew. @param planes  the search stays on their positive sides
Layout polished(const LayoutJob& job, const CutMesh& cut, int max_panels, std::vector<int>& singular, Rework what,
                const std::vector<MirrorPlane>& planes = {}) {
    std::optional<Layout> layout;
    for (int round = 0;; ++round) {
        layout.emplace(layout_on(job, mended(job, layout ? layout->cut() : cut, singular), max_panels, Stage::polish));
        for (const MirrorPlane& plane : planes) layout->keep_one_side(plane.point, plane.normal);
        if (round == repair_rounds || !layout->rework(what)) return std::move(*layout);
    }
}

/// The same job with work of its own to spend. @param part  of the surface that is searched
LayoutJob with_effort(const LayoutJob& job, double part) {
    LayoutJob own = job;
    own.rules.effort = std::make_shared<Effort>(Effort{job.params.layout_effort * part * std::max(least_work, work_per_face * job.s.n_faces()), 0});
    return own;
}

/// A layout as it was searched for, and what was compared on the way.
struct Found {
    Layout layout;
    std::vector<CandidateCurve> candidates;
};

Found free_layout(const LayoutJob& whole_job, const Base& base) {
    const LayoutJob job = with_effort(whole_job, base.work);
    CutMesh cut = uncut(job, base.mesh);
    if (base.has_creases) mark_crease_seams(cut, crease_angle(job), job.params.min_width);
    Layout layout = layout_on(job, std::move(cut), job.params.max_panels, Stage::search);
    for (std::size_t i = 0; i < job.strokes.size(); ++i)
        if (!layout.add_curve(stroke_curve(layout, job.strokes[i], static_cast<int>(i)), true))
            throw arcsim::InputError("segment: stroke " + std::to_string(i + 1) + " crosses itself. Draw it as several strokes.");
    layout.search();
    layout.rework(Rework::all, search_share);
    std::vector<int> singular = singular_nodes(job, layout.cut().surface());
    return {polished(job, layout.cut(), job.params.max_panels, singular, Rework::all), layout.candidates()};
}

/// The layout of the part on one side of all planes, and its mirror images; nothing when they do not fit.
/// @param what  is laid out anew: a first look does without what only looks bad
std::optional<Found> mirrored_layout(const LayoutJob& whole_job, const Base& base, const std::vector<MirrorPlane>& planes, Rework what) {
    const LayoutJob job = with_effort(whole_job, base.work / static_cast<double>(1 << planes.size()));
    MeshOnInput settled = base.mesh;
    for (const MirrorPlane& plane : planes) settle_on_plane(settled, base.topology, plane, job.s, job.topology);
    const int max_panels = std::max(1, job.params.max_panels >> planes.size());
    Layout part = layout_on(job, uncut(job, settled), max_panels, Stage::search);
    for (const MirrorPlane& plane : planes) {
        const Surface mesh = part.cut().surface();
        const Topology topology = arcsim::build_topology(mesh, "segment");
        for (Curve& curve : plane_curves(mesh, topology, plane)) {
            snap_curve(topology, curve, 0.1);
            if (curve.size() < 3 || !part.add_curve(curve, false)) return {};
        }
    }
    for (const MirrorPlane& plane : planes) part.keep_one_side(plane.point, plane.normal);
    if (part.n_panels() == 0) return {};
    part.search();
    part.rework(what, search_share);
    std::vector<CandidateCurve> candidates = part.candidates();
    std::vector<int> singular = singular_nodes(job, part.cut().surface());
    part = polished(job, part.cut(), max_panels, singular, what, planes);
    MirroredMesh whole = mirror_part(part.cut(), part.kept_faces(), job.s, job.topology, planes);
    if (!whole.is_sound) return {};
    CutMesh cut = uncut(job, whole.mesh);
    for (const auto& [a, b] : whole.seams) cut.mark_seam(a, b);
    Layout layout = layout_on(job, std::move(cut), job.params.max_panels, Stage::polish);
    for (const std::vector<int>& image : whole.face_image) layout.merge_images(image);
    for (const MirrorPlane& plane : planes)
        for (std::size_t i = 0, n = candidates.size(); i < n; ++i) {
            candidates.push_back(candidates[i]);
            for (Vector3d& x : candidates.back().points) x = plane.mirror(x);
        }
    return Found{std::move(layout), std::move(candidates)};
}

/// Two planes at right angles, when there are such, and the best plane alone.
std::vector<std::vector<MirrorPlane>> plane_sets(const LayoutJob& job, const Base& base) {
    std::vector<std::vector<MirrorPlane>> sets;
    if (job.params.symmetry != Symmetry::detect || !job.strokes.empty() || base.has_creases || job.params.max_panels < 2) return sets;
    std::vector<MirrorPlane> planes = find_mirror_planes(job.s, job.topology);
    const double close = 0.25 * arcsim::mean_edge_length(job.s);
    std::erase_if(planes, [&](const MirrorPlane& p) { return p.deviation >= close; });
    if (planes.empty()) return sets;
    for (std::size_t i = 1; i < planes.size() && job.params.max_panels >= 4; ++i)
        if (std::abs(planes[0].normal.dot(planes[i].normal)) < 0.02) {
            sets.push_back({planes[0], planes[i]});
            break;
        }
    sets.push_back({planes[0]});
    return sets;
}

/// The cut mesh mended as it is handed over, by the bounds themselves.
Layout judged(const LayoutJob& job, const CutMesh& cut) {
    std::vector<int> singular = singular_nodes(job, cut.surface());
    return layout_on(job, mended(job, cut, singular), job.params.max_panels, Stage::verdict);
}

/// Darts where they help, on the mesh that is handed over; judged as before.
Layout with_darts(const LayoutJob& job, Layout judged_layout) {
    Layout layout = judged_layout;   // by the same rules: what is known of its panels serves
    if (layout.keeps_bounds() || !layout.add_darts()) return layout;
    Layout darted = judged(job, layout.cut());
    return darted.cost() < judged_layout.cost() ? std::move(darted) : std::move(judged_layout);
}

/// The cheapest of a free layout and those that keep mirror planes. A symmetric bag is worth some panels.
Found best_layout(const LayoutJob& job, const Base& base) {
    constexpr double worth_of_symmetry = 2;      // times the free layout's cost
    constexpr double worth_of_two_planes = 1.4;  // times that of one plane: each pattern is cut four times instead of twice
    std::optional<Found> best;
    double most = std::numeric_limits<double>::infinity();   // that another layout may cost to be taken
    const auto offer = [&](const std::vector<MirrorPlane>& planes, Rework what) {
        auto found = mirrored_layout(job, base, planes, what);
        if (!found) return false;
        Layout layout = judged(job, found->layout.cut());
        if (layout.n_panels() < 2 || layout.cost() >= most) return false;
        most = layout.cost() / (planes.size() > 1 && layout.keeps_bounds() ? worth_of_two_planes : 1);
        best.emplace(Found{std::move(layout), std::move(found->candidates)});
        return true;
    };
    for (const auto& planes : plane_sets(job, base)) {   // after a first one that keeps the bounds, another must win at first look
        const bool is_second = best && best->layout.keeps_bounds();
        if (offer(planes, is_second ? Rework::out_of_bounds : Rework::all) && is_second) offer(planes, Rework::all);
    }
    if (best && best->layout.keeps_bounds()) return std::move(*best);
    Found free = free_layout(job, base);
    free.layout = judged(job, free.layout.cut());
    return best && best->layout.cost() < worth_of_symmetry * free.layout.cost() ? std::move(*best) : std::move(free);
}

/// Everything that the next stages ask for of a mended cut mesh.
Segmentation hand_over(const LayoutJob& job, const CutMesh& cut, std::vector<CandidateCurve> candidates) {
    const std::vector<int> singular = singular_nodes(job, cut.surface());
    Layout layout = layout_on(job, cut, job.params.max_panels, Stage::verdict);
    Segmentation r;
    r.field = job.field;
    r.singularities = job.singularities;
    for (std::size_t i = 0; i < singular.size(); ++i) r.singularities[i].node = singular[i];
    r.mesh = layout.cut().surface();
    r.source = layout.cut().source();
    r.source_face = layout.cut().source_face();
    r.panel = label_panels(layout.cut(), r.n_panels);
    r.seams = collect_seams(layout.cut(), r.panel);
    SurfaceField on_cut = layout.field_on(r.mesh, r.source_face);
    r.field_theta = std::move(on_cut.theta);
    r.direction = std::move(on_cut.data);
    r.violations = layout.violations();
    r.candidates = std::move(candidates);
    return r;
}

}  // namespace

SplitRules split_rules(const SegmentParams& params) {
    SplitRules rules;
    rules.drift = {params.drift_penalty, params.max_angle_deg * degree};
    rules.min_width = params.min_width;
    rules.max_distortion = params.max_distortion;
    return rules;
}

Segmentation mend_and_hand_over(const LayoutJob& job, const CutMesh& cut, std::vector<CandidateCurve> candidates) {
    return hand_over(job, judged(job, cut).cut(), std::move(candidates));
}

Segmentation lay_out(const LayoutJob& job) {
    const Base base = base_mesh(job);
    Found found = best_layout(job, base);
    if (base.is_coarse) {
        int n = 0;
        const std::vector<int> panel = label_panels(found.layout.cut(), n);
        if (auto cut = transfer_seams(found.layout.cut(), panel, n, job.s, job.topology)) {
            found.layout = judged(job, *cut);
        } else {   // panels too narrow for the coarse mesh
            Base whole = whole_mesh(job);
            whole.work = 0.5;
            found = best_layout(job, whole);
        }
    }
    const Layout layout = with_darts(job, std::move(found.layout));
    return hand_over(job, layout.cut(), std::move(found.candidates));
}

}  // namespace formwork
