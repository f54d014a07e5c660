#include "formwork/sew/surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "arcsim/base/error.hpp"

namespace formwork {
namespace {

constexpr int leaf_size = 4;

double squared_distance(const Vector3d& q, const Vector3d& low, const Vector3d& high) {
    return (low - q).cwiseMax(q - high).cwiseMax(0.0).squaredNorm();
}

}  // namespace

Vector3d closest_on_triangle(const Vector3d& q, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    // The regions of a triangle's plane, corner by corner and edge by edge, told apart by projections.
    const Vector3d ab = b - a, ac = c - a;
    const double a1 = ab.dot(q - a), a2 = ac.dot(q - a);
    if (a1 <= 0 && a2 <= 0) return a;
    const double b1 = ab.dot(q - b), b2 = ac.dot(q - b);
    if (b1 >= 0 && b2 <= b1) return b;
    const double wc = a1 * b2 - b1 * a2;
    if (wc <= 0 && a1 >= 0 && b1 <= 0) return a + a1 / (a1 - b1) * ab;
    const double c1 = ab.dot(q - c), c2 = ac.dot(q - c);
    if (c2 >= 0 && c1 <= c2) return c;
    const double wb = c1 * a2 - a1 * c2;
    if (wb <= 0 && a2 >= 0 && c2 <= 0) return a + a2 / (a2 - c2) * ac;
    const double wa = b1 * c2 - c1 * b2, from_b = b2 - b1, from_c = c1 - c2;
    if (wa <= 0 && from_b >= 0 && from_c >= 0) return b + from_b / (from_b + from_c) * (c - b);
    return a + (wb * ab + wc * ac) / (wa + wb + wc);
}

SurfaceDistance::SurfaceDistance(const Surface& surface) : surface_(surface) {
    const int n = surface_.n_faces();
    if (n == 0) throw arcsim::InputError("deviation: the surface to compare with has no faces");
    node_normal_.assign(surface_.x.size(), Vector3d::Zero());
    std::map<std::pair<int, int>, Vector3d> edges;
    for (int f = 0; f < n; ++f) {
        const Triangle& t = surface_.faces[f];
        const Vector3d normal = area_vector(surface_, f).normalized();
        for (int k = 0; k < 3; ++k) {
            const int i = t[k], j = t[(k + 1) % 3], l = t[(k + 2) % 3];
            const Vector3d p = (surface_.x[j] - surface_.x[i]).normalized(), q = (surface_.x[l] - surface_.x[i]).normalized();
            node_normal_[i] += std::acos(std::clamp(p.dot(q), -1.0, 1.0)) * normal;
            edges.try_emplace(std::minmax(j, l), Vector3d::Zero()).first->second += normal;
        }
    }
    edge_normal_.resize(n);
    for (int f = 0; f < n; ++f)
        for (int k = 0; k < 3; ++k)
            edge_normal_[f][k] = edges.at(std::minmax(surface_.faces[f][(k + 1) % 3], surface_.faces[f][(k + 2) % 3]));
    order_.resize(n);
    std::iota(order_.begin(), order_.end(), 0);
    boxes_.reserve(n);
    build(0, n);
}

int SurfaceDistance::build(int first, int count) {
    const int index = static_cast<int>(boxes_.size());
    boxes_.emplace_back();
    const double far = std::numeric_limits<double>::infinity();
    Vector3d low = Vector3d::Constant(far), high = -low;
    for (int k = first; k < first + count; ++k)
        for (int node : surface_.faces[order_[k]]) {
            low = low.cwiseMin(surface_.x[node]);
            high = high.cwiseMax(surface_.x[node]);
        }
    boxes_[index] = {low, high, first, count, 0};
    if (count <= leaf_size) return index;
    const Vector3d size = high - low;
    const int axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
    const int half = count / 2;
    const auto key = [&](int f) { return arcsim::face_centroid(surface_, f)[axis]; };
    std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                     [&](int a, int b) { return std::make_pair(key(a), a) < std::make_pair(key(b), b); });
    boxes_[index].count = 0;
    build(first, half);
    const int right = build(first + half, count - half);
    boxes_[index].right = right;
    return index;
}

void SurfaceDistance::search(int box, const Vector3d& q, double& best, Vector3d& point, int& face) const {
    const Box& b = boxes_[box];
    if (squared_distance(q, b.low, b.high) >= best) return;
    for (int k = b.first; k < b.first + b.count; ++k) {
        const Triangle& t = surface_.faces[order_[k]];
        const Vector3d p = closest_on_triangle(q, surface_.x[t[0]], surface_.x[t[1]], surface_.x[t[2]]);
        const double d = (p - q).squaredNorm();
        if (d < best) best = d, point = p, face = order_[k];
    }
    if (b.count > 0) return;
    const int left = box + 1, right = b.right;
    const bool left_first = squared_distance(q, boxes_[left].low, boxes_[left].high) <=
                            squared_distance(q, boxes_[right].low, boxes_[right].high);
    search(left_first ? left : right, q, best, point, face);
    search(left_first ? right : left, q, best, point, face);
}

/// The normal that tells inside from outside correctly also where the closest point is an edge or a node.
Vector3d SurfaceDistance::pseudonormal(int face, const Vector3d& point) const {
    const Triangle& t = surface_.faces[face];
    const Vector3d area = area_vector(surface_, face);
    constexpr double tiny = 1e-9;   // of the face: below it the point lies on an edge or in a corner
    double weight[3];
    int zeros = 0, which = 0, other = 0;
    for (int k = 0; k < 3; ++k) {
        const Vector3d& p = surface_.x[t[(k + 1) % 3]];
        const Vector3d& r = surface_.x[t[(k + 2) % 3]];
        weight[k] = 0.5 * (p - point).cross(r - point).dot(area) / std::max(area.squaredNorm(), 1e-300);
        if (weight[k] < tiny) ++zeros, which = k;
        else other = k;
    }
    if (zeros == 0) return area;
    return zeros == 1 ? edge_normal_[face][which] : node_normal_[t[other]];
}

SurfaceDistance::Closest SurfaceDistance::closest(const Vector3d& q) const {
    Closest c;
    double best = std::numeric_limits<double>::infinity();
    search(0, q, best, c.point, c.face);
    c.signed_distance = std::copysign(std::sqrt(best), pseudonormal(c.face, c.point).dot(q - c.point));
    return c;
}

Deviation deviation(const Surface& from, const SurfaceDistance& to) {
    std::vector<double> area(from.x.size(), 0);
    for (int f = 0; f < from.n_faces(); ++f)
        for (int node : from.faces[f]) area[node] += arcsim::face_area(from, f) / 3;
    Deviation d;
    double sum = 0, total = 0;
    for (int i = 0; i < from.n_nodes(); ++i) {
        const double s = to.closest(from.x[i]).signed_distance;
        d.per_node.push_back(s);
        sum += area[i] * s * s;
        total += area[i];
        if (area[i] > 0 && std::abs(s) >= d.max) d.max = std::abs(s), d.worst_node = i;
    }
    d.rms = total > 0 ? std::sqrt(sum / total) : 0;
    return d;
}

}  // namespace formwork
