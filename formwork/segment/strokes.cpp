#include "formwork/segment/strokes.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "arcsim/base/error.hpp"
#include "formwork/segment/surface_curve.hpp"

namespace formwork {

Curve stroke_curve(const Layout& layout, const Stroke& stroke, int number) {
    const std::string name = "segment: stroke " + std::to_string(number + 1) + ": ";
    if (stroke.size() < 2) throw arcsim::InputError(name + "a line needs at least two points.");
    const Surface& s = layout.cut().surface();
    const Topology t = arcsim::build_topology(s, "segment");
    const FieldGraph graph(s, t, layout.field_on(s, layout.cut().source_face()), {0, 0.7854}, 1);
    const auto nearest = [&](const Vector3d& x, bool rim) {
        int best = -1;
        for (int v = 0; v < s.n_nodes(); ++v)
            if (!graph.is_singular(v) && t.is_boundary_node(v) == rim && (best < 0 || (s.x[v] - x).squaredNorm() < (s.x[best] - x).squaredNorm()))
                best = v;
        return best;
    };
    const std::size_t n = stroke.size();
    std::vector<int> stops;
    for (std::size_t i = 0; i < n; ++i) {
        const Vector3d& x = stroke[i];
        const int rim = nearest(x, true);
        const bool is_end = i == 0 || i + 1 == n;
        const bool at_rim = is_end && rim >= 0 && (s.x[rim] - x).norm() < 2 * arcsim::mean_edge_length(s);
        const int stop = at_rim ? rim : nearest(x, false);
        if (stops.empty() || stops.back() != stop) stops.push_back(stop);   // points closer than an edge are one
    }
    if (stops.size() < 2) throw arcsim::InputError(name + "is shorter than one edge of the mesh.");
    Path path;
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
        const auto step = plain_path(graph, {stops[i]}, {stops[i + 1]});
        if (!step) throw arcsim::InputError(name + "no way on the surface joins its points. Keep inner points off the rim.");
        path.samples.insert(path.samples.end(), step->samples.begin() + (i > 0), step->samples.end());
    }
    std::set<int> once(path.samples.begin(), path.samples.end());
    const bool closed = path.samples.front() == path.samples.back();
    Curve curve;
    if (once.size() + closed == path.samples.size()) curve = crossing_curve(s, t, graph, path);
    if (curve.empty()) throw arcsim::InputError(name + "crosses itself. Draw it as several strokes.");
    smooth_curve(s, curve, 4);
    snap_curve(t, curve, 0.22);
    return curve;
}

}  // namespace formwork
