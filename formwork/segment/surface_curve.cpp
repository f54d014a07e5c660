#include "formwork/segment/surface_curve.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace formwork {
namespace {

/// The faces that hold both points.
std::vector<int> shared_faces(const Topology& t, const CurvePoint& p, int p_edge, const CurvePoint& q, int q_edge) {
    const auto faces = [&](const CurvePoint& c, int e) {
        if (c.is_node()) return t.node_faces[c.a];
        std::vector<int> both{t.edges[e].face[0]};
        if (t.edges[e].face[1] >= 0) both.push_back(t.edges[e].face[1]);
        return both;
    };
    std::vector<int> shared;
    const auto of_q = faces(q, q_edge);
    for (int f : faces(p, p_edge))
        if (std::find(of_q.begin(), of_q.end(), f) != of_q.end()) shared.push_back(f);
    return shared;
}

int edge_between(const Topology& t, int f, int g) {
    for (int e : t.face_edges[f])
        if (t.edges[e].face[0] == g || t.edges[e].face[1] == g) return e;
    return -1;
}

/// The faces from f to g around a vertex on the side with fewer of them, f and g included.
std::vector<int> turn_around(const Surface& s, const Topology& t, int v, int f, int g) {
    const auto walk = [&](int side) {   // 1: counter-clockwise, 2: clockwise
        std::vector<int> faces{f};
        while (faces.back() != g) {
            const int next = t.neighbour(faces.back(), (arcsim::corner_of(s.faces[faces.back()], v) + side) % 3);
            if (next < 0 || next == f) return std::vector<int>{};
            faces.push_back(next);
        }
        return faces;
    };
    const auto left = walk(1), right = walk(2);
    if (left.empty() || right.empty()) return left.empty() ? right : left;
    return left.size() <= right.size() ? left : right;
}

}  // namespace

Curve crossing_curve(const Surface& s, const Topology& t, const FieldGraph& graph, const Path& path) {
    const auto edge_of = [&](const CurvePoint& p) {
        if (p.is_node()) return -1;
        for (int f : t.node_faces[p.a])
            for (int e : t.face_edges[f]) {
                const auto& n = t.edges[e].node;
                if ((n[0] == p.a && n[1] == p.b) || (n[0] == p.b && n[1] == p.a)) return e;
            }
        return -1;
    };
    const bool closed = path.samples.front() == path.samples.back();
    // Strip of faces under the walk: one face per step, joined by fans around the vertices passed.
    std::vector<int> strip;
    std::vector<std::pair<int, double>> crossing_hint;   // edge -> parameter where the walk crosses it
    for (std::size_t i = 0; i + 1 < path.samples.size(); ++i) {
        const CurvePoint p = graph.point(path.samples[i]), q = graph.point(path.samples[i + 1]);
        const int pe = edge_of(p), qe = edge_of(q);
        const auto shared = shared_faces(t, p, pe, q, qe);
        if (shared.empty()) return {};
        int f = shared.front();
        if (!strip.empty() && std::find(shared.begin(), shared.end(), strip.back()) != shared.end()) f = strip.back();
        if (!strip.empty() && f != strip.back()) {
            if (p.is_node()) {
                const auto fan = turn_around(s, t, p.a, strip.back(), f);
                if (fan.empty()) return {};
                strip.insert(strip.end(), fan.begin() + 1, fan.end());
            } else {
                strip.push_back(f);
            }
        } else if (strip.empty()) {
            strip.push_back(f);
        }
        if (!q.is_node()) crossing_hint.emplace_back(qe, q.t);
    }
    if (closed) {   // close the strip around the first sample
        const CurvePoint p = graph.point(path.samples.front());
        if (strip.front() != strip.back()) {
            const auto fan = turn_around(s, t, p.a, strip.back(), strip.front());
            if (fan.empty()) return {};
            strip.insert(strip.end(), fan.begin() + 1, fan.end());
        }
    }
    std::vector<int> straight;   // without steps there and back
    for (int f : strip) {
        if (straight.size() >= 2 && straight[straight.size() - 2] == f)
            straight.pop_back();
        else if (straight.empty() || straight.back() != f)
            straight.push_back(f);
    }
    Curve curve;
    if (!closed) curve.push_back(graph.point(path.samples.front()));
    const auto vertex_near = [&](int a, int b) {   // an edge crossed beside a vertex of the walk
        for (int i : path.samples)
            if (i == a) return 0.15;
            else if (i == b) return 0.85;
        return 0.5;
    };
    std::set<int> crossed;
    for (std::size_t i = 0; i + 1 < straight.size(); ++i) {
        const int e = edge_between(t, straight[i], straight[i + 1]);
        if (e < 0 || !crossed.insert(e).second) return {};
        const auto& n = t.edges[e].node;
        double at = vertex_near(n[0], n[1]);
        for (const auto& [edge, parameter] : crossing_hint)
            if (edge == e) at = parameter;
        curve.push_back({n[0], n[1], at});
    }
    if (closed) {
        if (curve.size() < 3) return {};
        curve.push_back(curve.front());
    } else {
        curve.push_back(graph.point(path.samples.back()));
    }
    return curve;
}

void smooth_curve(const Surface& s, Curve& curve, int rounds) {
    const auto same = [](const CurvePoint& p, const CurvePoint& q) { return p.a == q.a && p.b == q.b; };
    const int n = static_cast<int>(curve.size());
    const bool closed = n > 3 && same(curve.front(), curve.back()) && !curve.front().is_node();
    constexpr double margin = 0.02;   // of the edge: a point never slides over a vertex
    for (int round = 0; round < rounds; ++round)
        for (int parity = 0; parity < 2; ++parity)
            for (int i = closed ? 0 : 1; i + 1 < n; ++i) {
                if (i % 2 != parity || curve[i].is_node()) continue;
                const Vector3d p = position(s, curve[i == 0 ? n - 2 : i - 1]), q = position(s, curve[i + 1]);
                const Vector3d a = s.x[curve[i].a], edge = s.x[curve[i].b] - a;
                const double length = edge.norm();
                const Vector3d u = edge / length;
                const double px = u.dot(p - a), qx = u.dot(q - a);
                const double py = (p - a - px * u).norm(), qy = (q - a - qx * u).norm();
                if (py + qy < 1e-12 * length) continue;
                const double target = (px * qy + qx * py) / (py + qy) / length;
                curve[i].t = std::clamp(0.5 * (curve[i].t + target), margin, 1 - margin);
                if (closed && i == 0) curve.back().t = curve.front().t;
            }
}

void snap_curve(const Topology& t, Curve& curve, double reach) {
    const int n = static_cast<int>(curve.size());
    const bool closed = n > 3 && curve.front().a == curve.back().a && curve.front().b == curve.back().b;
    const auto snapped = [&](const CurvePoint& p) {
        if (p.is_node() || (p.t > reach && p.t < 1 - reach)) return p;
        return CurvePoint{p.t < 0.5 ? p.a : p.b, -1, 0};
    };
    std::vector<int> taken_at(t.node_faces.size(), -1);   // last point of the curve that uses the vertex
    for (int i = 0; i < n; ++i)
        if (curve[i].is_node()) taken_at[curve[i].a] = i;
    if (!closed)
        for (int i : {0, n - 1}) {
            curve[i] = snapped(curve[i]);
            if (curve[i].is_node()) taken_at[curve[i].a] = i;
        }
    for (int i = closed ? 0 : 1; i < n - 1; ++i) {
        const CurvePoint p = snapped(curve[i]);
        if (curve[i].is_node() || !p.is_node()) continue;
        const int used = taken_at[p.a];
        const bool free = used < 0 || used == i - 1 || (i > 0 && curve[i - 1].is_node() && curve[i - 1].a == p.a);
        const bool ends_here = (i == 1 && !closed && curve[0].is_node() && curve[0].a == p.a) ||
                               (i == n - 2 && !closed && curve[n - 1].is_node() && curve[n - 1].a == p.a);
        if (ends_here || (free && !t.is_boundary_node(p.a))) {
            curve[i] = p;
            taken_at[p.a] = i;
        } else {
            curve[i].t = std::clamp(curve[i].t, reach, 1 - reach);
        }
    }
    if (closed) curve.back() = curve.front();
    // Points that fell together, and steps along an edge into or out of a vertex: the way straight there stays
    // in the same face.
    const auto touches = [](const CurvePoint& p, int v) { return !p.is_node() && (p.a == v || p.b == v); };
    Curve kept;
    for (int i = 0; i < static_cast<int>(curve.size()); ++i) {
        const CurvePoint& p = curve[i];
        const bool is_end = i == 0 || i + 1 == static_cast<int>(curve.size());
        if (p.is_node()) {
            while (kept.size() > 1 && touches(kept.back(), p.a)) kept.pop_back();
            if (!kept.empty() && kept.back().is_node() && kept.back().a == p.a) continue;
        } else if (!is_end && !kept.empty() && kept.back().is_node() && touches(p, kept.back().a)) {
            continue;
        }
        kept.push_back(p);
    }
    curve = std::move(kept);
}

double curve_length(const Surface& s, const Curve& curve) {
    double length = 0;
    for (std::size_t i = 0; i + 1 < curve.size(); ++i)
        length += (position(s, curve[i + 1]) - position(s, curve[i])).norm();
    return length;
}

}  // namespace formwork
