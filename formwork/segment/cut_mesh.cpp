#include "formwork/segment/cut_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>

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
    join_faces();
}

CutMesh::CutMesh(const Surface& input, Surface cut, std::vector<SurfacePoint> source, std::vector<int> source_face)
    : input_(&input), surface_(std::move(cut)), source_(std::move(source)), source_face_(std::move(source_face)),
      split_from_(surface_.faces.size(), -1) {
    join_faces();
}

void CutMesh::join_faces() {
    const std::size_t n = surface_.x.size();
    side_.assign(surface_.faces.size(), {});
    face_at_.assign(n, -1);
    std::vector<int> start(n + 1, 0);   // edges by their lower node
    const auto lower = [](const arcsim::Triangle& t, int k) { return std::min(t[k], t[(k + 1) % 3]); };
    for (const arcsim::Triangle& t : surface_.faces)
        for (int k = 0; k < 3; ++k) ++start[lower(t, k) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    struct Open {
        int higher, face, k;
    };
    std::vector<Open> open(3 * surface_.faces.size());
    std::vector<int> end(start.begin(), start.end() - 1);
    for (int f = 0; f < surface_.n_faces(); ++f) {
        const arcsim::Triangle& t = surface_.faces[f];
        for (int k = 0; k < 3; ++k) {
            if (face_at_[t[k]] < 0) face_at_[t[k]] = f;
            const int lo = lower(t, k), hi = std::max(t[k], t[(k + 1) % 3]);
            const auto last = open.begin() + end[lo];
            const auto other = std::find_if(open.begin() + start[lo], last, [&](const Open& o) { return o.higher == hi; });
            if (other == last) {
                *last = {hi, f, k};
                ++end[lo];
            } else {
                side_[f][k].across = other->face;
                side_[other->face][other->k].across = f;
            }
        }
    }
}

CutMesh::Corner CutMesh::side_left(int a, int b) const {
    const int first = face_at_[a];
    for (int turn = 0; turn < 2; ++turn)   // counter-clockwise about a, then clockwise if a rim stopped us
        for (int f = first; f >= 0;) {
            const arcsim::Triangle& t = surface_.faces[f];
            const int k = t[0] == a ? 0 : t[1] == a ? 1 : 2;
            if (t[(k + 1) % 3] == b) return {f, k};
            f = side_[f][turn == 0 ? (k + 2) % 3 : k].across;
            if (f == first) return {};
        }
    return {};
}

CutMesh::Mark CutMesh::mark_of(int a, int b) const {
    Corner c = side_left(a, b);
    if (c.face < 0) c = side_left(b, a);
    return c.face < 0 ? Mark::none : side_[c.face][c.k].mark;
}

void CutMesh::set_mark(int a, int b, Mark mark) {
    for (const Corner c : {side_left(a, b), side_left(b, a)})
        if (c.face >= 0) side_[c.face][c.k].mark = mark;
}

SurfacePoint CutMesh::locate(int face, const Vector3d& x) const {
    SurfacePoint p{source_face_[face], barycentric_coordinates(*input_, source_face_[face], x)};
    double sum = 0;
    for (double& b : p.barycentric) sum += b = std::clamp(b, 0., 1.);
    for (double& b : p.barycentric) b /= sum;
    return p;
}

/// The face a -> b -> c becomes a -> m -> c and a new one, m -> b -> c. @returns the new one
int CutMesh::split_side(Corner side, int m) {
    const auto [f, k] = side;
    const int g = surface_.n_faces(), k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    const arcsim::Triangle t = surface_.faces[f];
    const int a = t[k], b = t[k1], c = t[k2];
    const std::array<Side, 3> old = side_[f];
    surface_.faces.push_back({m, b, c});
    source_face_.push_back(source_face_[f]);
    split_from_.push_back(f);
    side_.push_back({{{-1, old[k].mark}, old[k1], {f, Mark::none}}});
    surface_.faces[f] = {a, m, c};
    side_[f] = {{{-1, old[k].mark}, {g, Mark::none}, old[k2]}};
    if (const int beyond = old[k1].across; beyond >= 0)
        for (int j = 0; j < 3; ++j)
            if (surface_.faces[beyond][j] == c && surface_.faces[beyond][(j + 1) % 3] == b) side_[beyond][j].across = g;
    face_at_[b] = g;
    face_at_[m] = f;
    return g;
}

int CutMesh::split_edge(int a, int b, double t) {
    const int m = surface_.n_nodes();
    const Corner left = side_left(a, b), right = side_left(b, a);
    assert(left.face >= 0 || right.face >= 0);
    surface_.x.push_back((1 - t) * surface_.x[a] + t * surface_.x[b]);
    source_.push_back(locate(left.face >= 0 ? left.face : right.face, surface_.x[m]));
    face_at_.push_back(-1);
    const int left_beyond = left.face >= 0 ? split_side(left, m) : -1;     // at b; the face itself stays at a
    const int right_beyond = right.face >= 0 ? split_side(right, m) : -1;   // at a; the face itself stays at b
    if (left_beyond >= 0 && right_beyond >= 0) {   // split faces begin with the edge that was split
        side_[left.face][0].across = right_beyond;
        side_[left_beyond][0].across = right.face;
        side_[right.face][0].across = left_beyond;
        side_[right_beyond][0].across = left.face;
    }
    return m;
}

std::vector<int> CutMesh::insert(const Curve& curve) {
    constexpr double same_point = 1e-3;   // of the edge: nearer points of a curve are one, or faces between them had no area
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
        if ((left != a && t - t0 < same_point) || (right != b && t1 - t < same_point)) {   // met twice: a closed curve
            nodes.push_back(left != a && t - t0 < same_point ? left : right);
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
