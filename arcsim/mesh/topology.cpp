#include "arcsim/mesh/topology.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "arcsim/base/error.hpp"

namespace arcsim {
namespace {

struct HalfEdge {
    int from, to, face, corner;   // corner: opposite the half-edge
};

/// The half-edges of one undirected edge: the first two, and how many there are.
struct EdgeGroup {
    std::array<HalfEdge, 2> half;
    int size = 0;
};

/// Half-edges grouped by undirected edge, groups in the order in which the faces first name them.
std::vector<EdgeGroup> group_half_edges(const Surface& s) {
    std::vector<EdgeGroup> groups;
    groups.reserve(s.faces.size() * 3 / 2 + 16);
    std::vector<int> start(s.x.size() + 1, 0);   // per lower node: where its edges stand in `at_lower`
    const auto lower = [&](int f, int k) { return std::min(s.faces[f][k], s.faces[f][(k + 1) % 3]); };
    for (int f = 0; f < s.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) ++start[lower(f, k) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::pair<int, int>> at_lower(3 * s.faces.size());   // (higher node, group), edges of one node together
    std::vector<int> end(start.begin(), start.end() - 1);
    for (int f = 0; f < s.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = s.faces[f][(k + 1) % 3], b = s.faces[f][(k + 2) % 3], lo = std::min(a, b), hi = std::max(a, b);
            const auto first = at_lower.begin() + start[lo], last = at_lower.begin() + end[lo];
            const auto known = std::find_if(first, last, [&](const auto& e) { return e.first == hi; });
            const int g = known == last ? static_cast<int>(groups.size()) : known->second;
            if (known == last) {
                *last = {hi, g};
                ++end[lo];
                groups.emplace_back();
            }
            EdgeGroup& group = groups[g];
            if (group.size < 2) group.half[group.size] = {a, b, f, k};
            ++group.size;
        }
    return groups;
}

/// The faces of `node` as one counter-clockwise fan; shorter than `around` when there are several fans.
std::vector<int> order_fan(const Surface& s, const Topology& t, int node, std::span<const int> around) {
    // Going counter-clockwise leaves a face over the edge opposite its next corner.
    int start = around.front();
    for (std::size_t i = 0; i < around.size(); ++i) {   // walk clockwise to the boundary, if there is one
        const int back = t.neighbour(start, (corner_of(s.faces[start], node) + 2) % 3);
        if (back < 0) break;
        start = back;
    }
    std::vector<int> fan;
    fan.reserve(around.size());
    for (int f = start; f >= 0 && fan.size() < around.size();) {
        fan.push_back(f);
        f = t.neighbour(f, (corner_of(s.faces[f], node) + 1) % 3);
        if (f == start) break;
    }
    return fan;
}

std::string edge_name(const std::array<int, 2>& e) {
    return "edge " + std::to_string(e[0] + 1) + "-" + std::to_string(e[1] + 1);
}

/// Edges of a surface whose edges have one or two faces.
Topology connect(const Surface& s, const std::vector<EdgeGroup>& groups) {
    Topology t;
    t.face_edges.resize(s.faces.size());
    t.edges.reserve(groups.size());
    t.boundary_node.assign(s.x.size(), 0);
    for (const EdgeGroup& group : groups) {
        const auto& [first, second] = group.half;
        Edge e{{first.from, first.to}, {first.face, -1}, {first.corner, -1}};
        t.face_edges[first.face][first.corner] = static_cast<int>(t.edges.size());
        if (group.size > 1) {
            e.face[1] = second.face;
            e.corner[1] = second.corner;
            t.face_edges[second.face][second.corner] = static_cast<int>(t.edges.size());
        } else {
            t.boundary_node[first.from] = t.boundary_node[first.to] = 1;
        }
        t.edges.push_back(e);
    }
    return t;
}

void find_components(const Surface& s, Topology& t) {
    t.component.assign(s.x.size(), -1);
    for (int seed = 0; seed < s.n_nodes(); ++seed) {
        if (t.component[seed] >= 0 || t.node_faces[seed].empty()) continue;
        std::vector<int> stack{seed};
        t.component[seed] = t.n_components;
        while (!stack.empty()) {
            const int v = stack.back();
            stack.pop_back();
            for (int f : t.node_faces[v])
                for (int w : s.faces[f])
                    if (t.component[w] < 0) {
                        t.component[w] = t.n_components;
                        stack.push_back(w);
                    }
        }
        ++t.n_components;
    }
}

void find_boundary_loops(Topology& t) {
    std::vector<int> next(t.component.size(), -1), starts;   // next: node after it on the boundary, until a loop has passed
    for (const Edge& e : t.edges)
        if (e.is_boundary()) {
            next[e.node[0]] = e.node[1];
            starts.push_back(e.node[0]);
        }
    for (int start : starts) {
        if (next[start] < 0) continue;
        std::vector<int> loop;
        for (int v = start; next[v] >= 0;) {
            loop.push_back(v);
            v = std::exchange(next[v], -1);
        }
        t.boundary_loops.push_back(std::move(loop));
    }
}

}  // namespace

double bend_angle(const Surface& s, const Edge& e) {
    const Vector3d a = face_normal(s, e.face[0]), b = face_normal(s, e.face[1]);
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

int Topology::euler_characteristic() const {
    const auto used = std::count_if(component.begin(), component.end(), [](int c) { return c >= 0; });
    return static_cast<int>(used) - static_cast<int>(edges.size()) + static_cast<int>(face_edges.size());
}

namespace {

/// Defects, and, where there are none, edges and fans.
TopologyDefects examine(const Surface& s, Topology& t) {
    TopologyDefects d;
    for (int f = 0; f < s.n_faces(); ++f) {
        const Triangle& c = s.faces[f];
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) d.repeated_corner_faces.push_back(f);
    }
    std::vector<int> start(s.x.size() + 1, 0), corners(3 * s.faces.size());   // faces around each node
    for (const Triangle& c : s.faces)
        for (int v : c) ++start[v + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<int> fill(start.begin(), start.end() - 1);
    for (int f = 0; f < s.n_faces(); ++f)
        for (int v : s.faces[f]) corners[fill[v]++] = f;
    const auto around = [&](int v) { return std::span<const int>(corners.data() + start[v], corners.data() + start[v + 1]); };
    for (int v = 0; v < s.n_nodes(); ++v)
        if (around(v).empty()) d.isolated_nodes.push_back(v);
    if (!d.repeated_corner_faces.empty()) return d;

    const auto groups = group_half_edges(s);
    for (const EdgeGroup& g : groups) {
        const std::array<int, 2> e{g.half[0].from, g.half[0].to};
        if (g.size > 2)
            d.nonmanifold_edges.push_back(e);
        else if (g.size == 2 && g.half[0].from == g.half[1].from)
            d.misoriented_edges.push_back(e);
    }
    if (!d.nonmanifold_edges.empty() || !d.misoriented_edges.empty()) return d;

    t = connect(s, groups);
    t.node_faces.resize(s.x.size());
    for (int v = 0; v < s.n_nodes(); ++v) {
        if (around(v).empty()) continue;
        t.node_faces[v] = order_fan(s, t, v, around(v));
        if (t.node_faces[v].size() < around(v).size()) d.nonmanifold_nodes.push_back(v);
    }
    return d;
}

}  // namespace

TopologyDefects find_defects(const Surface& s) {
    Topology t;
    return examine(s, t);
}

Topology build_topology(const Surface& s, const std::string& source_name) {
    Topology t;
    const TopologyDefects d = examine(s, t);
    const auto fail = [&](const std::string& what) { throw InputError(source_name + ": " + what); };
    if (!d.repeated_corner_faces.empty())
        fail("face " + std::to_string(d.repeated_corner_faces[0] + 1) +
             " names the same node twice. Delete the face.");
    if (!d.nonmanifold_edges.empty())
        fail(edge_name(d.nonmanifold_edges[0]) + " belongs to three or more faces (" +
             std::to_string(d.nonmanifold_edges.size()) +
             " such edges). A bag's surface needs one or two faces at every edge: delete inner walls or doubled faces.");
    if (!d.misoriented_edges.empty())
        fail("the two faces at " + edge_name(d.misoriented_edges[0]) + " are oriented against each other (" +
             std::to_string(d.misoriented_edges.size()) +
             " such edges). Unify the normals in your modeller.");
    if (!d.nonmanifold_nodes.empty())
        fail("node " + std::to_string(d.nonmanifold_nodes[0] + 1) +
             " joins parts of the surface that share no edge there (" +
             std::to_string(d.nonmanifold_nodes.size()) + " such nodes). Split the node.");

    find_components_and_loops(s, t);
    return t;
}

void find_components_and_loops(const Surface& s, Topology& t) {
    find_components(s, t);
    find_boundary_loops(t);
}

}  // namespace arcsim
