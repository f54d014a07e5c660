#include "formwork/segment/dart.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "formwork/segment/field_paths.hpp"
#include "formwork/segment/surface_curve.hpp"

namespace formwork {
namespace {

constexpr int estimate_cells = 400;
constexpr int smoothing_rounds = 10;
constexpr double snap_reach = 0.22;   // of an edge: nearer points move onto the vertex
constexpr double sharp = 0.3;         // rad of angle defect: a vertex that is a tip by itself

/// The inner vertex where the stretch to be expected is largest, or the sharp tip close to it; -1: none off the border.
int tip_of(const PanelPatch& p, double reach) {
    const StretchModel model(p, estimate_cells);
    int tip = -1;
    for (int v : model.nodes_by_stretch())
        if (!p.topology.is_boundary_node(v)) {
            tip = v;
            break;
        }
    if (tip < 0) return -1;
    double most = sharp;
    const Vector3d middle = p.surface.x[tip];
    for (int v = 0; v < p.surface.n_nodes(); ++v) {
        if (p.topology.is_boundary_node(v) || (p.surface.x[v] - middle).norm() > reach) continue;
        const double defect = 2 * std::numbers::pi - angle_sum(p, v);
        if (defect <= most) continue;
        most = defect;
        tip = v;
    }
    return tip;
}

}  // namespace

std::vector<Curve> dart_curves(const PanelPatch& p, const SurfaceField& field, const SplitRules& rules) {
    const int tip = tip_of(p, rules.min_width);
    if (tip < 0) return {};
    std::set<std::pair<int, int>> across;   // edges of the tip's faces that do not meet in it
    for (int f : p.topology.node_faces[tip]) {
        const Triangle& t = p.surface.faces[f];
        const int k = arcsim::corner_of(t, tip);
        const int a = t[(k + 1) % 3], b = t[(k + 2) % 3];
        if (p.topology.is_boundary_node(a) || p.topology.is_boundary_node(b)) return {};
        across.insert(std::minmax(a, b));
    }
    const FieldGraph graph(p.surface, p.topology, field, rules.drift, 1);
    std::vector<int> ring, border;   // the ring begins inside its edges: its nodes may all be singular, and no path leaves those
    for (int i = 0; i < graph.n_samples(); ++i) {
        const CurvePoint& q = graph.point(i);
        if (graph.is_border(i)) border.push_back(i);
        if (!q.is_node() && across.count(std::minmax(q.a, q.b))) ring.push_back(i);
    }
    auto path = plain_path(graph, ring, border);
    if (!path) return {};
    path->samples.insert(path->samples.begin(), tip);
    std::reverse(path->samples.begin(), path->samples.end());
    Curve whole = crossing_curve(p.surface, p.topology, graph, *path);
    if (whole.size() < 3) return {};
    smooth_curve(p.surface, whole, smoothing_rounds);
    std::vector<Curve> darts;
    const double length = curve_length(p.surface, whole);
    for (double share : {1., 0.75, 0.5}) {
        Curve dart{whole[0]};
        for (std::size_t i = 1; i < whole.size() && (i < 3 || curve_length(p.surface, dart) < share * length); ++i) dart.push_back(whole[i]);
        snap_curve(p.topology, dart, snap_reach);
        if (dart.size() > 1) darts.push_back(std::move(dart));
    }
    return darts;
}

}  // namespace formwork
