#include "formwork/segment/strokes.hpp"

#include <algorithm>
#include <limits>
#include <queue>
#include <set>

#include "arcsim/base/error.hpp"
#include "formwork/segment/surface_curve.hpp"

namespace formwork {
namespace {

constexpr double on_edges = 0.15;   // of the mean edge: a leg whose mesh nodes stay this close runs along edges

double distance_to_segment(const Vector3d& x, const Vector3d& a, const Vector3d& b) {
    const Vector3d d = b - a;
    const double u = std::clamp((x - a).dot(d) / std::max(d.squaredNorm(), 1e-300), 0., 1.);
    return (a + u * d - x).norm();
}

/// The way from node a to node b along edges of the mesh that lie on the straight line between them; empty: there is
/// none. A stroke drawn along a fold of the mesh must stay on it: off the fold, it would cut over to the other side.
std::vector<int> edge_leg(const Surface& s, const Topology& t, int a, int b) {
    const double reach = on_edges * arcsim::mean_edge_length(s);
    std::vector<double> cost(s.x.size(), std::numeric_limits<double>::infinity());
    std::vector<int> before(s.x.size(), -1);
    using Item = std::pair<double, int>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    queue.emplace(cost[a] = 0, a);
    while (!queue.empty()) {
        const auto [c, v] = queue.top();
        queue.pop();
        if (v == b) break;
        if (c > cost[v]) continue;
        for (int f : t.node_faces[v])
            for (int w : s.faces[f]) {
                const double d = c + (s.x[w] - s.x[v]).norm();
                if (d >= cost[w] || distance_to_segment(s.x[w], s.x[a], s.x[b]) > reach) continue;
                cost[w] = d;
                before[w] = v;
                queue.emplace(d, w);
            }
    }
    if (before[b] < 0) return {};
    std::vector<int> nodes;
    for (int v = b; v >= 0; v = before[v]) nodes.push_back(v);
    std::reverse(nodes.begin(), nodes.end());
    return nodes;
}

int nearest_node(const Surface& s, const Topology& t, const Vector3d& x, bool on_rim, const FieldGraph* regular_in = nullptr) {
    int best = -1;
    for (int v = 0; v < s.n_nodes(); ++v)
        if ((!regular_in || !regular_in->is_singular(v)) && t.is_boundary_node(v) == on_rim &&
            (best < 0 || (s.x[v] - x).squaredNorm() < (s.x[best] - x).squaredNorm()))
            best = v;
    return best;
}

/// The mesh node of every point of the stroke that starts a new one; the ends go on to a near rim.
std::vector<int> stops_of(const Surface& s, const Topology& t, const Stroke& stroke) {
    std::vector<int> stops;
    for (std::size_t i = 0; i < stroke.size(); ++i) {
        const Vector3d& x = stroke[i];
        const int rim = nearest_node(s, t, x, true);
        const bool is_end = i == 0 || i + 1 == stroke.size();
        const bool at_rim = is_end && rim >= 0 && (s.x[rim] - x).norm() < 2 * arcsim::mean_edge_length(s);
        const int stop = at_rim ? rim : nearest_node(s, t, x, false);
        if (stops.empty() || stops.back() != stop) stops.push_back(stop);   // points closer than an edge are one
    }
    return stops;
}

/// Edge legs between the stops. Legs across faces follow the graph, which has no way through a singular node: there the
/// stop moves to the next node.
std::vector<std::vector<int>> legs_of(const Surface& s, const Topology& t, const FieldGraph& graph, std::vector<int>& stops) {
    const auto find = [&] {
        std::vector<std::vector<int>> legs;
        for (std::size_t i = 0; i + 1 < stops.size(); ++i) legs.push_back(edge_leg(s, t, stops[i], stops[i + 1]));
        return legs;
    };
    auto legs = find();
    bool moved = false;
    for (std::size_t i = 0; i < stops.size(); ++i) {
        const bool needs_graph = (i > 0 && legs[i - 1].empty()) || (i < legs.size() && legs[i].empty());
        if (!needs_graph || !graph.is_singular(stops[i])) continue;
        stops[i] = nearest_node(s, t, s.x[stops[i]], false, &graph);
        moved = true;
    }
    return moved ? find() : legs;
}

}  // namespace

Curve stroke_curve(const Layout& layout, const Stroke& stroke, int number) {
    const std::string name = "segment: stroke " + std::to_string(number + 1) + ": ";
    if (stroke.size() < 2) throw arcsim::InputError(name + "a line needs at least two points.");
    const Surface& s = layout.cut().surface();
    const Topology t = arcsim::build_topology(s, "segment");
    const FieldGraph graph(s, t, layout.field_on(s, layout.cut().source_face()), {0, 0.7854}, 1);
    std::vector<int> stops = stops_of(s, t, stroke);
    if (stops.size() < 2) throw arcsim::InputError(name + "is shorter than one edge of the mesh.");

    const auto legs = legs_of(s, t, graph, stops);
    Curve curve;
    std::vector<int> samples;   // every sample passed, to see whether the stroke meets itself
    Path free;                  // legs across faces that are not yet part of the curve
    const auto crosses = [&] { return arcsim::InputError(name + "crosses itself. Draw it as several strokes."); };
    const auto append = [&](const Curve& part) { curve.insert(curve.end(), part.begin() + !curve.empty(), part.end()); };
    const auto add_free = [&] {
        if (free.samples.empty()) return;
        Curve part = crossing_curve(s, t, graph, free);
        if (part.empty()) throw crosses();
        smooth_curve(s, part, 4);
        snap_curve(t, part, 0.22);
        append(part);
        free.samples.clear();
    };
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
        const std::vector<int>& edges = legs[i];
        if (!edges.empty()) {
            add_free();
            Curve part;
            for (int v : edges) part.push_back({v, -1, 0});
            append(part);
            samples.insert(samples.end(), edges.begin() + !samples.empty(), edges.end());
            continue;
        }
        const auto step = plain_path(graph, {stops[i]}, {stops[i + 1]});
        if (!step) throw arcsim::InputError(name + "no way on the surface joins its points. Keep inner points off the rim.");
        free.samples.insert(free.samples.end(), step->samples.begin() + !free.samples.empty(), step->samples.end());
        samples.insert(samples.end(), step->samples.begin() + !samples.empty(), step->samples.end());
    }
    add_free();
    const std::set<int> once(samples.begin(), samples.end());
    if (once.size() + (samples.front() == samples.back()) != samples.size()) throw crosses();
    return curve;
}

}  // namespace formwork
