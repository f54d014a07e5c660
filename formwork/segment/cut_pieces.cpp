#include "formwork/segment/cut_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <set>

#include "formwork/segment/panel_outline.hpp"

namespace formwork {

BorderPlaces::BorderPlaces(const PanelPatch& p, double care)
    : loop(p.node.size(), -1), place(p.node.size(), 0), is_corner(p.node.size(), 0) {
    for (std::size_t l = 0; l < p.topology.boundary_loops.size(); ++l) {
        const auto& nodes = p.topology.boundary_loops[l];
        loop_size.push_back(static_cast<int>(nodes.size()));
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            loop[nodes[i]] = static_cast<int>(l);
            place[nodes[i]] = static_cast<double>(i);
        }
    }
    for (int v : corner_nodes(p, care)) is_corner[v] = 1;
}

double BorderPlaces::place_of(const CurvePoint& q) const {
    if (q.is_node()) return place[q.a];
    const double a = place[q.a], b = place[q.b];
    return std::abs(a - b) > 1.5 ? std::max(a, b) + 0.5 : 0.5 * (a + b);
}

int most_corners_after(const PanelPatch& p, const BorderPlaces& places, const CurvePoint& a, const CurvePoint& b) {
    const auto& nodes = p.topology.boundary_loops[places.loop[a.a]];
    const double from = std::min(places.place_of(a), places.place_of(b)), to = std::max(places.place_of(a), places.place_of(b));
    int inside = 2, outside = 2;
    for (int v : nodes) {
        if (!places.is_corner[v] || places.place[v] == from || places.place[v] == to) continue;
        ++(places.place[v] > from && places.place[v] < to ? inside : outside);
    }
    return std::max(inside, outside);
}

CutPieces cut_pieces(const PanelPatch& p, const Curve& curve) {
    const Surface& s = p.surface;
    std::set<std::pair<int, int>> crossed;
    std::vector<double> distance(s.n_nodes(), std::numeric_limits<double>::infinity());
    using Item = std::pair<double, int>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    for (int v = 0; v < s.n_nodes(); ++v)
        if (p.topology.is_boundary_node(v)) queue.emplace(distance[v] = 0, v);
    std::vector<char> blocked(s.n_nodes(), 0);
    for (const CurvePoint& q : curve) {
        if (q.is_node()) {
            queue.emplace(distance[q.a] = 0, q.a);
            blocked[q.a] = 1;
            continue;
        }
        crossed.emplace(std::minmax(q.a, q.b));
        for (int v : {q.a, q.b}) {
            const double d = (s.x[v] - position(s, q)).norm();
            if (d < distance[v]) queue.emplace(distance[v] = d, v);
        }
    }
    std::vector<char> near(s.n_nodes(), 0);   // at an edge that is crossed
    for (const auto& [a, b] : crossed) near[a] = near[b] = 1;
    const auto passable = [&](int a, int b) { return !near[a] || !near[b] || !crossed.count(std::minmax(a, b)); };
    const EdgeLengths graph(p);
    while (!queue.empty()) {
        const auto [d, v] = queue.top();
        queue.pop();
        if (d > distance[v]) continue;
        for (const auto& [w, l] : graph.around(v))
            if (d + l < distance[w] && passable(v, w)) queue.emplace(distance[w] = d + l, w);
    }
    std::vector<char> seen(s.n_nodes(), 0);
    CutPieces pieces;
    std::vector<int> stack;
    for (int seed = 0; seed < s.n_nodes(); ++seed) {
        if (seen[seed] || blocked[seed]) continue;
        double widest = 0;
        seen[seed] = 1;
        stack.assign(1, seed);
        while (!stack.empty()) {
            const int v = stack.back();
            stack.pop_back();
            widest = std::max(widest, distance[v]);
            for (const auto& [w, l] : graph.around(v))
                if (!seen[w] && !blocked[w] && passable(v, w)) {
                    seen[w] = 1;
                    stack.push_back(w);
                }
        }
        ++pieces.count;
        pieces.least_width = std::min(pieces.least_width, 2 * widest);
    }
    return pieces;
}

std::vector<PanelPatch> split_pieces(const PanelPatch& patch, const Curve& curve) {
    CutMesh cut(patch.surface);
    if (cut.insert_seam(curve).empty()) return {};
    int n = 0;
    const std::vector<int> panel = label_panels(cut, n);
    std::vector<PanelPatch> pieces;
    for (const auto& faces : panel_faces(panel, n)) pieces.push_back(extract_patch(cut, faces));
    return pieces;
}

}  // namespace formwork
