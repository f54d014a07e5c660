#include "formwork/segment/cut_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <map>

namespace formwork {

std::array<double, 3> barycentric_coordinates(const Surface& s, int f, const Vector3d& x) {
    const arcsim::Triangle& t = s.faces[f];
    const Vector3d n = (s.x[t[1]] - s.x[t[0]]).cross(s.x[t[2]] - s.x[t[0]]);
    const double nn = n.squaredNorm();
    std::array<double, 3> b{};
    for (int k = 0; k < 2; ++k)
        b[k] = (s.x[t[(k + 2) % 3]] - s.x[t[(k + 1) % 3]]).cross(x - s.x[t[(k + 1) % 3]]).dot(n) / nn;
    b[2] = 1 - b[0] - b[1];
    return b;
}

CutMesh::CutMesh(const Surface& input) : input_(&input), surface_(input), source_(input.n_nodes()) {
    source_face_.resize(input.faces.size());
    split_from_.assign(input.faces.size(), -1);
    for (int f = 0; f < input.n_faces(); ++f) {
        source_face_[f] = f;
        const arcsim::Triangle& t = input.faces[f];
        for (int k = 0; k < 3; ++k) {
            source_[t[k]] = {f, {k == 0 ? 1. : 0., k == 1 ? 1. : 0., k == 2 ? 1. : 0.}};
        }
    }
    number_edges();
}

CutMesh::CutMesh(const Surface& input, Surface cut, std::vector<SurfacePoint> source, std::vector<int> source_face)
    : input_(&input), surface_(std::move(cut)), source_(std::move(source)), source_face_(std::move(source_face)),
      split_from_(surface_.faces.size(), -1) {
    number_edges();
}

void CutMesh::number_edges() {
    left_.reserve(3 * surface_.faces.size());
    for (int f = 0; f < surface_.n_faces(); ++f) {
        const arcsim::Triangle& t = surface_.faces[f];
        for (int k = 0; k < 3; ++k) left_.set(t[k], t[(k + 1) % 3], f);
    }
}

int CutMesh::face_left(int a, int b) const {
    const int* face = left_.find(a, b);
    return face ? *face : -1;
}

void CutMesh::set_face(int f, const arcsim::Triangle& t) {
    surface_.faces[f] = t;
    for (int k = 0; k < 3; ++k) left_.set(t[k], t[(k + 1) % 3], f);
}

SurfacePoint CutMesh::locate(int face, const Vector3d& x) const {
    SurfacePoint p{source_face_[face], barycentric_coordinates(*input_, source_face_[face], x)};
    double sum = 0;
    for (double& b : p.barycentric) sum += b = std::clamp(b, 0., 1.);
    for (double& b : p.barycentric) b /= sum;
    return p;
}

void CutMesh::split_face(int f, int a, int b, int m) {
    const arcsim::Triangle& t = surface_.faces[f];
    const int c = t[0] + t[1] + t[2] - a - b;
    const int g = surface_.n_faces();
    surface_.faces.push_back({m, b, c});
    source_face_.push_back(source_face_[f]);
    split_from_.push_back(f);
    set_face(g, {m, b, c});
    set_face(f, {a, m, c});
}

int CutMesh::split_edge(int a, int b, double t) {
    const int m = surface_.n_nodes();
    const int f = face_left(a, b), g = face_left(b, a);
    assert(f >= 0 || g >= 0);
    surface_.x.push_back((1 - t) * surface_.x[a] + t * surface_.x[b]);
    source_.push_back(locate(f >= 0 ? f : g, surface_.x[m]));
    left_.erase(a, b);
    left_.erase(b, a);
    if (f >= 0) split_face(f, a, b, m);
    if (g >= 0) split_face(g, b, a, m);
    if (is_seam(a, b)) {
        const bool given = is_given(a, b);
        unmark_seam(a, b);
        mark_seam(a, m, given);
        mark_seam(m, b, given);
    }
    return m;
}

bool CutMesh::flip(int a, int b) {
    const int f = face_left(a, b), g = face_left(b, a);
    if (f < 0 || g < 0 || is_seam(a, b)) return false;
    const arcsim::Triangle &s = surface_.faces[f], &t = surface_.faces[g];
    const int c = s[0] + s[1] + s[2] - a - b, d = t[0] + t[1] + t[2] - a - b;
    if (face_left(c, d) >= 0 || face_left(d, c) >= 0) return false;
    left_.erase(a, b);
    left_.erase(b, a);
    set_face(f, {c, a, d});
    set_face(g, {d, b, c});
    return true;
}

void CutMesh::move(int node, const SurfacePoint& where, const Vector3d& x) {
    surface_.x[node] = x;
    source_[node] = where;
}

std::vector<int> CutMesh::insert(const Curve& curve) {
    std::map<std::pair<int, int>, std::vector<std::pair<double, int>>> split;   // edge a < b -> (t, node), sorted
    std::vector<int> nodes;
    for (const CurvePoint& p : curve) {
        if (p.is_node()) {
            nodes.push_back(p.a);
            continue;
        }
        const bool ordered = p.a < p.b;
        const int a = std::min(p.a, p.b), b = std::max(p.a, p.b);
        const double t = ordered ? p.t : 1 - p.t;
        auto& on_edge = split[{a, b}];   // the two ends of a curve may lie on the two sides of one seam edge
        const auto above = std::find_if(on_edge.begin(), on_edge.end(), [&](const auto& q) { return q.first > t; });
        const auto [t1, right] = above == on_edge.end() ? std::pair{1., b} : *above;
        const auto [t0, left] = above == on_edge.begin() ? std::pair{0., a} : *(above - 1);
        if (left != a && t - t0 < 1e-6) {   // the same point met twice: a closed curve
            nodes.push_back(left);
            continue;
        }
        const int m = split_edge(left, right, (t - t0) / (t1 - t0));
        on_edge.insert(above, {t, m});
        nodes.push_back(m);
    }
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

std::vector<int> CutMesh::insert_seam(const Curve& curve, bool given) {
    const std::vector<int> nodes = insert(curve);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
        if (face_left(nodes[i], nodes[i + 1]) < 0 && face_left(nodes[i + 1], nodes[i]) < 0) return {};
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
        if (!is_rim(nodes[i], nodes[i + 1])) mark_seam(nodes[i], nodes[i + 1], given);
    return nodes;
}

}  // namespace formwork
