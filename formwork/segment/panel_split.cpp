#include "formwork/segment/panel_split.hpp"

#include <algorithm>
#include <cmath>

#include "formwork/segment/cut_pieces.hpp"
#include "formwork/segment/field_paths.hpp"
#include "formwork/segment/surface_curve.hpp"

namespace formwork {
namespace {

constexpr double snap_reach = 0.22;   // of an edge: nearer points move onto the vertex
constexpr int smoothing_rounds = 10;
constexpr int trial_cells = 400;      // of the coarse panel on which candidates are compared
constexpr int most_port_pairs = 24;
constexpr double infinite = std::numeric_limits<double>::infinity();

struct Candidate {
    Path path;
    CandidateCurve::Kind kind;
    StretchEstimate after;
    double score = 0;   // larger is better
    int seed = -1;
    bool is_enough = false;
};

Curve sample_points(const FieldGraph& graph, const Path& path) {
    Curve c;
    for (int i : path.samples) c.push_back(graph.point(i));
    return c;
}

class Search {
public:
    Search(const PanelPatch& patch, const SurfaceField& field, const SplitRules& rules)
        : patch_(patch), rules_(rules), places_(patch, rules.care),
          graph_(patch.surface, patch.topology, field, rules.drift, patch.surface.n_faces() < 6000 ? 2 : 1),
          model_(patch, trial_cells), is_disk_(patch.is_disk()), is_closed_(patch.topology.boundary_loops.empty()) {
        starts_ = start_nodes();
        if (!is_closed_) before_ = model_.whole();
    }

    std::vector<Split> along_field(int count, std::vector<CandidateCurve>* all) {
        if (is_closed_)
            collect_loops();
        else
            collect_crossings();
        if (all) report_candidates(*all);
        std::stable_sort(found_.begin(), found_.end(), [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
        std::vector<Split> best;
        std::vector<Vector3d> middles;
        const double spacing = rules_.spacing > 0 ? rules_.spacing : 0.25 * rules_.min_width;
        for (std::size_t i = 0; i < found_.size() && i < 40 && static_cast<int>(best.size()) < count; ++i) {
            const auto& samples = found_[i].path.samples;
            const Vector3d middle = position(patch_.surface, graph_.point(samples[samples.size() / 2]));
            const bool is_new = std::none_of(middles.begin(), middles.end(), [&](const Vector3d& m) {
                return (m - middle).norm() < spacing;
            });
            if (!is_new) continue;
            if (auto split = finish(found_[i])) {
                best.push_back(std::move(*split));
                middles.push_back(middle);
            }
        }
        return best;
    }

    std::optional<Split> anyhow() {
        const auto& loops = patch_.topology.boundary_loops;
        Candidate c;
        if (is_closed_) {   // a slit between a point and one of those far from it
            const auto ends = spread(2, {});
            if (ends.size() < 2) return {};
            const auto path = plain_path(graph_, {ends[0]}, {ends[1]});
            if (!path) return {};
            c.path = *path;
        } else if (loops.size() > 1) {
            std::vector<int> from = border_samples(0), to;
            for (std::size_t l = 1; l < loops.size(); ++l)
                for (int i : border_samples(static_cast<int>(l))) to.push_back(i);
            const auto path = plain_path(graph_, from, to);
            if (!path) return {};
            c.path = *path;
        } else {
            return {};
        }
        return finish(c, true);
    }

private:
    void report_candidates(std::vector<CandidateCurve>& all) const {
        for (const Candidate& c : found_) {
            Curve curve = crossing_curve(patch_.surface, patch_.topology, graph_, c.path);   // as it would be sewn
            if (curve.empty()) curve = sample_points(graph_, c.path);
            else smooth_curve(patch_.surface, curve, smoothing_rounds);
            all.push_back({c.kind, c.path.cost, {}});
            for (const CurvePoint& p : curve) all.back().points.push_back(position(patch_.surface, p));
        }
    }

    std::vector<int> border_samples(int loop) const {
        std::vector<int> samples;
        for (int i = 0; i < graph_.n_samples(); ++i)
            if (graph_.is_border(i) && places_.loop[graph_.point(i).a] == loop) samples.push_back(i);
        return samples;
    }

    /// One inner node of every cell that the graph can start from.
    std::vector<int> start_nodes() const {
        std::vector<int> nodes;
        for (int v : model_.cell_nodes()) {
            int start = -1;
            for (int f : patch_.topology.node_faces[v])
                for (int w : patch_.surface.faces[f])
                    if (!graph_.is_singular(w) && !graph_.is_border(w) && (start < 0 || w == v)) start = w;
            if (start >= 0) nodes.push_back(start);
        }
        return nodes;
    }

    /// Nodes spread over the patch, each as far as possible from the ones before, in straight distance.
    std::vector<int> spread(int count, std::vector<int> chosen) const {
        const auto& nodes = starts_;
        std::vector<double> far(nodes.size(), infinite);
        const Surface& s = patch_.surface;
        const auto account = [&](int v) {
            for (std::size_t i = 0; i < nodes.size(); ++i) far[i] = std::min(far[i], (s.x[nodes[i]] - s.x[v]).squaredNorm());
        };
        for (int v : chosen) account(v);
        while (static_cast<int>(chosen.size()) < count && !nodes.empty()) {
            const auto i = std::max_element(far.begin(), far.end()) - far.begin();
            if (far[i] <= 0) break;
            chosen.push_back(nodes[i]);
            account(chosen.back());
        }
        return chosen;
    }

    /// Ends at a junction cost nothing; ends close to one would leave a narrow step and cost extra.
    std::vector<double> landing_costs() const {
        const Surface& s = patch_.surface;
        std::vector<double> landing(graph_.n_samples(), 0);
        std::vector<Vector3d> junctions;
        for (int v = 0; v < s.n_nodes(); ++v)
            if (patch_.junction[v]) junctions.push_back(s.x[v]);
        const double near = 0.6 * rules_.min_width;
        for (int i = 0; i < graph_.n_samples(); ++i) {
            if (!graph_.is_border(i)) continue;
            const CurvePoint q = graph_.point(i);
            if (q.is_node() && patch_.junction[q.a]) continue;
            const Vector3d x = position(s, q);
            for (const Vector3d& j : junctions)
                if ((x - j).norm() < near) landing[i] = 2 * rules_.min_width;
        }
        return landing;
    }

    void try_path(const std::optional<Path>& path, CandidateCurve::Kind kind, int seed) {
        if (!path || path->samples.size() < 3) return;
        Candidate c{*path, kind, model_.with_cut(sample_points(graph_, *path)), 0, seed, false};
        const double flat = std::pow(0.4 * rules_.max_distortion, 2);   // stretch that nobody sees
        if (is_closed_) {
            c.score = -path->cost * std::sqrt(c.after.energy / c.after.area + flat);
        } else {
            const CurvePoint a = graph_.point(path->samples.front()), b = graph_.point(path->samples.back());
            const bool joins_loops = places_.loop[a.a] != places_.loop[b.a];
            const bool divides = c.after.smallest_piece > 0;
            if (is_disk_) {
                if (!divides || c.after.smallest_piece < 0.5 * std::pow(rules_.min_width, 2)) return;
                const int corners = most_corners_after(patch_, places_, a, b);
                c.score = std::max(1e-30, before_.energy - c.after.energy);
                c.is_enough = c.after.p95 * rules_.calibration < rules_.max_distortion;
                if (c.is_enough) c.score = 1e6 / path->cost;
                if (corners > rules_.max_corners) c.score *= 1e-3 / corners;
            } else {
                c.score = -path->cost * std::sqrt(c.after.energy / c.after.area + flat);
                if (!joins_loops && (divides || patch_.topology.boundary_loops.size() > 1)) return;   // no step towards a disk
            }
        }
        found_.push_back(std::move(c));
    }

    void collect_loops() {
        double best = infinite;
        const auto seeds = spread(std::max(4, rules_.trials / 2), {});
        for (int v : seeds)
            for (int layer = 0; layer < 2; ++layer) {
                if (graph_.is_singular(v)) continue;
                const auto path = closed_path(graph_, v, layer, 4 * best);
                if (path) best = std::min(best, path->cost);
                try_path(path, CandidateCurve::Kind::loop, v);
            }
    }

    void collect_crossings() {
        const BorderPaths paths(graph_, landing_costs());
        std::set<int> used;
        const auto try_seed = [&](int v) {
            if (graph_.is_border(v) || graph_.is_singular(v) || !used.insert(v).second) return;
            for (int layer = 0; layer < 2; ++layer) try_path(paths.through(v, layer), CandidateCurve::Kind::crossing, v);
        };
        std::vector<int> first;   // where the stretch is largest, then all over
        const auto order = model_.nodes_by_stretch();
        if (!order.empty()) first.push_back(order.front());
        for (int v : spread(rules_.trials, first)) try_seed(v);
        const auto& ports = graph_.ports();
        struct Pair {
            double cost;
            std::size_t i, j;
        };
        std::vector<Pair> pairs;
        for (std::size_t i = 0; i < ports.size(); ++i)
            for (std::size_t j = i + 1; j < ports.size() && ports[j].vertex == ports[i].vertex; ++j)
                pairs.push_back({paths.cost(ports[i]) + paths.cost(ports[j]), i, j});
        std::erase_if(pairs, [](const Pair& p) { return !(p.cost < infinite); });
        std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.cost > b.cost; });
        int n_tried = 0;
        for (const Pair& p : pairs) {   // the long ones divide most
            const auto path = paths.through_ports(ports[p.i], ports[p.j]);
            if (!path) continue;
            try_path(path, CandidateCurve::Kind::separatrix, path->samples[path->samples.size() / 2]);
            if (++n_tried == most_port_pairs) break;
        }
        // Look again close to the best.
        for (int round = 0; round < 2 && !found_.empty(); ++round) {
            const auto best = std::max_element(found_.begin(), found_.end(),
                                               [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
            const Vector3d x = position(patch_.surface, graph_.point(best->seed));
            std::vector<std::pair<double, int>> close;
            for (int v : starts_) close.emplace_back((patch_.surface.x[v] - x).squaredNorm(), v);
            const std::size_t n = std::min<std::size_t>(close.size(), 10);
            std::partial_sort(close.begin(), close.begin() + static_cast<std::ptrdiff_t>(n), close.end());
            for (std::size_t i = 0; i < n; ++i) try_seed(close[i].second);
        }
    }

    std::optional<Split> finish(const Candidate& c, bool anything = false) const {
        Curve curve;
        const bool slit = is_closed_ && anything;
        curve = crossing_curve(patch_.surface, patch_.topology, graph_, c.path);
        if (curve.empty()) return {};
        smooth_curve(patch_.surface, curve, smoothing_rounds);
        snap_curve(patch_.topology, curve, snap_reach);
        if (curve.size() < 2 || (!slit && curve.size() < 3)) return {};
        const CutPieces pieces = cut_pieces(patch_, curve);
        if (!anything && is_disk_ && (pieces.count != 2 || pieces.least_width < rules_.min_width)) return {};
        if (!is_disk_ && !is_closed_ && pieces.count != 1) return {};   // must open the panel, not divide it
        return Split{curve, curve_length(patch_.surface, curve), c.path.cost, c.is_enough};
    }

    const PanelPatch& patch_;
    const SplitRules& rules_;
    BorderPlaces places_;
    FieldGraph graph_;
    StretchModel model_;
    bool is_disk_, is_closed_;
    StretchEstimate before_;
    std::vector<int> starts_;
    std::vector<Candidate> found_;
};

}  // namespace

std::vector<Split> best_splits(const PanelPatch& patch, const SurfaceField& field, const SplitRules& rules, int count,
                               std::vector<CandidateCurve>* all) {
    rules.effort->spent += patch.surface.n_faces();
    return Search(patch, field, rules).along_field(count, all);
}

std::optional<Split> plain_split(const PanelPatch& patch, const SurfaceField& field, const SplitRules& rules) {
    return Search(patch, field, rules).anyhow();
}

}  // namespace formwork
