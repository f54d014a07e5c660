#include "formwork/segment/field_graph.hpp"

#include <algorithm>
#include <cmath>

#include "formwork/segment/angle_transport.hpp"
#include "formwork/segment/degree.hpp"

namespace formwork {
namespace {

constexpr double least_landing = 30 * degree;   // between a curve's end and the border: no thin tips

int modulo4(int k) {
    return ((k % 4) + 4) % 4;
}

/// atan(t) for |t| <= 1, within 1e-5 rad [Abramowitz and Stegun 1964, 4.4.47]: costs are kept in single precision, and this is
/// asked for every pair of samples.
double small_angle(double t) {
    const double q = t * t;
    return t * (0.9998660 + q * (-0.3302995 + q * (0.1801410 + q * (-0.0851330 + q * 0.0208351))));
}

/// Stretch along a direction at angle `a` to the first principal direction.
double stretch_along(const DirectionData& d, double a) {
    const double c = d.s1 * std::cos(a), s = d.s2 * std::sin(a);
    return std::max(1e-3, std::sqrt(c * c + s * s));
}

}  // namespace

void FieldGraph::match(const Surface& s, const Topology& t, const SurfaceField& field) {
    const std::vector<double> kappa = transport_angles(s, t);
    edge_match_.assign(t.edges.size(), 0);
    for (std::size_t e = 0; e < t.edges.size(); ++e)
        if (!t.edges[e].is_boundary())
            edge_match_[e] = nearest_quarters(field.theta[t.edges[e].face[0]] + kappa[e] - field.theta[t.edges[e].face[1]]);
    vertex_layer_.assign(s.faces.size(), {0, 0, 0});
    fan_angle_.assign(s.faces.size(), {0, 0, 0});
    total_angle_.assign(s.x.size(), 0);
    singular_.assign(s.x.size(), 0);
    for (int v = 0; v < s.n_nodes(); ++v) {
        const auto& fan = t.node_faces[v];
        int layer = 0;
        double angle = 0;
        for (std::size_t i = 0; i < fan.size(); ++i) {
            const int f = fan[i], k = arcsim::corner_of(s.faces[f], v);
            vertex_layer_[f][k] = layer;
            fan_angle_[f][k] = angle;
            angle += corner_angle(s, f, k);
            const int e = t.face_edges[f][(k + 1) % 3];   // counter-clockwise over the edge opposite the next corner
            layer += t.edges[e].face[0] == f ? edge_match_[e] : -edge_match_[e];
        }
        total_angle_[v] = angle;
        singular_[v] = !t.is_boundary_node(v) && modulo4(layer) != 0;
        if (!t.is_boundary_node(v) && layer != 0) singular_[v] = 1;
    }
}

void FieldGraph::place_samples(const Surface& s, const Topology& t, int per_edge) {
    for (int v = 0; v < s.n_nodes(); ++v) {
        points_.push_back({v, -1, 0});
        border_.push_back(t.is_boundary_node(v));
    }
    for (const arcsim::Edge& e : t.edges)
        for (int j = 1; j <= per_edge; ++j) {
            points_.push_back({e.node[0], e.node[1], static_cast<double>(j) / (per_edge + 1)});
            border_.push_back(e.is_boundary());
        }
}

void FieldGraph::add_face(const Surface& s, const Topology& t, const SurfaceField& field, const DriftCost& cost,
                          int per_edge, int f, std::vector<Raw>& raw, std::vector<Leaving>& leaving) const {
    struct Local {
        int sample;
        Vector2d x;
        int offset;         // face layer = sample layer + offset
        int side;           // corner k: k; inside the edge opposite corner k: 3 + k
    };
    const arcsim::FaceFrame frame = arcsim::face_frame(s, f);
    const arcsim::Triangle& tri = s.faces[f];
    std::array<Vector2d, 3> corner;
    for (int k = 0; k < 3; ++k) corner[k] = frame.local(s.x[tri[k]] - s.x[tri[0]]);
    std::vector<Local> here;
    here.reserve(3 + 3 * static_cast<std::size_t>(per_edge));
    for (int k = 0; k < 3; ++k) here.push_back({tri[k], corner[k], vertex_layer_[f][k], k});
    for (int k = 0; k < 3; ++k) {
        const int e = t.face_edges[f][k];
        const bool forward = t.edges[e].face[0] == f;
        const Vector2d &a = corner[(k + 1) % 3], &b = corner[(k + 2) % 3];
        for (int j = 1; j <= per_edge; ++j) {
            const double along = static_cast<double>(forward ? j : per_edge + 1 - j) / (per_edge + 1);
            here.push_back({s.n_nodes() + e * per_edge + j - 1, a + along * (b - a), forward ? 0 : edge_match_[e], 3 + k});
        }
    }
    // Only neighbours along one edge, and whatever lies on different edges.
    const auto may_join = [&](const Local& p, const Local& q) {
        if (border_[p.sample] && border_[q.sample]) return false;
        const int ps = p.side, qs = q.side;
        if (ps >= 3 && qs >= 3) return ps != qs || std::abs(p.sample - q.sample) == 1;
        if (ps < 3 && qs < 3) return per_edge == 0;
        const int vertex = ps < 3 ? ps : qs, edge = (ps < 3 ? qs : ps) - 3;
        if (vertex == edge) return true;
        return ((p.x - q.x).norm() * (per_edge + 1)) <
               1.5 * (corner[(edge + 1) % 3] - corner[(edge + 2) % 3]).norm();
    };
    // Direction d leaving p: does it stay clear of the border there?
    const auto lands_well = [&](const Local& p, const Vector2d& d) {
        if (!border_[p.sample]) return true;
        if (p.side >= 3) {
            const int k = p.side - 3;
            const Vector2d edge = corner[(k + 2) % 3] - corner[(k + 1) % 3];
            return std::abs(edge.x() * d.y() - edge.y() * d.x()) > std::tan(least_landing) * std::abs(edge.dot(d));
        }
        const Vector2d edge = corner[(p.side + 1) % 3] - corner[p.side];
        const double angle = fan_angle_[f][p.side] + std::atan2(edge.x() * d.y() - edge.y() * d.x(), edge.dot(d));
        return angle > least_landing && angle < total_angle_[p.sample] - least_landing;
    };
    const auto is_singular = [&](const Local& p) { return p.side < 3 && singular_[p.sample]; };
    const auto add_arc = [&](const Local& p, const Local& q, int k, double c) {   // p -> q along arm k of the face
        if (is_singular(q)) return;
        const Arc arc{4 * q.sample + modulo4(k - q.offset), static_cast<float>(c)};
        if (is_singular(p))
            leaving.push_back({p.sample, f, modulo4(k), arc});
        else
            raw.push_back({4 * p.sample + modulo4(k - p.offset), arc});
    };
    const Vector2d arm(std::cos(field.theta[f]), std::sin(field.theta[f]));
    const int spread = cost.theta_max > quarter_turn / 2 + 1e-9 ? 1 : 0;
    std::array<double, 2> stretch;   // along the arms; opposite ones are alike
    for (int k = 0; k < 2; ++k) stretch[k] = stretch_along(field.data[f], field.theta[f] + k * quarter_turn - field.data[f].theta);
    for (std::size_t i = 0; i < here.size(); ++i)
        for (std::size_t j = i + 1; j < here.size(); ++j) {
            const Local &p = here[i], &q = here[j];
            if (!may_join(p, q)) continue;
            const Vector2d d = q.x - p.x;
            if (!lands_well(p, d) || !lands_well(q, -d)) continue;
            const double along = arm.dot(d), across = arm.x() * d.y() - arm.y() * d.x(), length = d.norm();
            const bool is_along = std::abs(along) >= std::abs(across);
            const int nearest = is_along ? (along > 0 ? 0 : 2) : across > 0 ? 1 : 3;
            const double least_drift = small_angle(is_along ? across / along : -along / across);
            for (int k = nearest - spread; k <= nearest + spread; ++k) {
                const double drift = least_drift - (k - nearest) * quarter_turn;
                if (std::abs(drift) > cost.theta_max + 1e-9) continue;
                const double r = drift / cost.theta_max;
                const double c = length / stretch[k & 1] * (1 + cost.alpha * r * r);
                add_arc(p, q, k, c);
                add_arc(q, p, k + 2, c);   // back along the opposite arm
            }
        }
}

FieldGraph::FieldGraph(const Surface& s, const Topology& t, const SurfaceField& field, const DriftCost& cost,
                       int per_edge) {
    match(s, t, field);
    place_samples(s, t, per_edge);
    std::vector<Raw> raw;
    raw.reserve(s.faces.size() * (per_edge > 1 ? 56 : 26));
    std::vector<Leaving> leaving;
    for (int f = 0; f < s.n_faces(); ++f) add_face(s, t, field, cost, per_edge, f, raw, leaving);
    start_.assign(n_nodes() + 1, 0);
    for (const Raw& r : raw) ++start_[r.from + 1];
    for (int i = 0; i < n_nodes(); ++i) start_[i + 1] += start_[i];
    arcs_.resize(raw.size());
    std::vector<int> fill(start_.begin(), start_.end() - 1);
    for (const Raw& r : raw) arcs_[fill[r.from]++] = r.arc;

    find_ports(s, field, std::move(leaving));
}

void FieldGraph::find_ports(const Surface& s, const SurfaceField& field, std::vector<Leaving> leaving) {
    const auto key = [](const Leaving& q) { return std::array{q.vertex, q.face, q.layer}; };
    std::stable_sort(leaving.begin(), leaving.end(), [&](const Leaving& p, const Leaving& q) { return key(p) < key(q); });
    for (std::size_t i = 0, end; i < leaving.size(); i = end) {
        for (end = i; end < leaving.size() && key(leaving[end]) == key(leaving[i]);) ++end;
        const auto [v, f, layer, first] = leaving[i];
        const int k = arcsim::corner_of(s.faces[f], v);   // an arm counts in the face whose sector it lies in
        const Vector3d to = s.x[s.faces[f][(k + 1) % 3]] - s.x[v];
        const double turn = field.theta[f] + layer * quarter_turn - arcsim::face_frame(s, f).angle(to);
        if (turn - 4 * quarter_turn * std::floor(turn / (4 * quarter_turn)) >= corner_angle(s, f, k)) continue;
        ports_.push_back({v, {}});
        for (std::size_t j = i; j < end; ++j) ports_.back().arcs.push_back(leaving[j].arc);
    }
}

}  // namespace formwork
