#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "formwork/segment/segmentation.hpp"
#include "tests/formwork/disk_meshes.hpp"

/// Surfaces cut by labels, for tests of what comes after the layout.
namespace cut_surfaces {

using arcsim::Surface;
using arcsim::Vector3d;
using formwork::Segmentation;

/// Cuts a surface along every edge between faces of different labels, along `slits` (node pairs inside one
/// label), and lists the rims. Seams are the longest chains with the same two panels beside them.
inline Segmentation cut_by_labels(const Surface& surface, const std::vector<int>& label,
                                  const std::set<std::pair<int, int>>& slits = {}) {
    Segmentation s;
    s.mesh = surface;
    s.panel = label;
    for (int f = 0; f < surface.n_faces(); ++f) {
        s.n_panels = std::max(s.n_panels, label[f] + 1);
        s.source_face.push_back(f);
        s.direction.push_back({});
        s.field_theta.push_back(0);
    }
    s.source.resize(surface.n_nodes());
    const arcsim::Topology t = arcsim::build_topology(surface);
    struct Cut {
        int left, right;
    };
    std::map<std::pair<int, int>, Cut> cut;   // directed, panel of the left face first
    std::map<int, std::vector<int>> star;
    for (const arcsim::Edge& e : t.edges) {
        const int a = e.node[0], b = e.node[1], left = label[e.face[0]];
        const int right = e.is_boundary() ? -1 : label[e.face[1]];
        if (left == right && !slits.count({a, b}) && !slits.count({b, a})) continue;
        cut[{a, b}] = {left, right};
        if (right >= 0) cut[{b, a}] = {right, left};
        star[a].push_back(b);
        star[b].push_back(a);
    }
    const auto directed = [&](int a, int b) { return cut.count({a, b}) ? cut.at({a, b}) : Cut{-2, -2}; };
    const auto same = [](Cut p, Cut q) { return p.left == q.left && p.right == q.right; };
    const auto is_end = [&](int node) {
        if (star[node].size() != 2) return true;
        const int a = star[node][0], b = star[node][1];
        return !same(directed(a, node), directed(node, b)) && !same(directed(b, node), directed(node, a));
    };
    std::set<std::pair<int, int>> done;
    const auto trace = [&](int a, int b) {
        if (done.count({a, b}) || done.count({b, a}) || !cut.count({a, b})) return;
        const Cut beside = cut.at({a, b});
        if (beside.right >= 0 && beside.left > beside.right) return;   // the other direction will do
        formwork::Seam seam;
        seam.panel = {beside.left, beside.right};
        seam.nodes = {a, b};
        done.insert({a, b});
        while (!is_end(seam.nodes.back()) && seam.nodes.back() != a) {
            const int here = seam.nodes.back(), before = seam.nodes[seam.nodes.size() - 2];
            const int next = star[here][0] == before ? star[here][1] : star[here][0];
            seam.nodes.push_back(next);
            done.insert({here, next});
        }
        s.seams.push_back(seam);
    };
    for (const auto& [node, others] : star)
        if (is_end(node))
            for (int other : others) trace(node, other);
    for (const auto& [edge, beside] : cut) trace(edge.first, edge.second);   // closed loops
    return s;
}

/// The unit sphere from an octahedron: coordinate planes are edges. Scaled to the radius.
inline Surface octasphere(int n, double radius) {
    Surface s;
    std::map<std::array<long, 3>, int> known;
    const auto node = [&](const Vector3d& p) {
        const auto [it, fresh] = known.try_emplace({std::lround(p.x()), std::lround(p.y()), std::lround(p.z())}, s.n_nodes());
        if (fresh) s.x.push_back(radius * p.normalized());
        return it->second;
    };
    for (int sx : {-1, 1})
        for (int sy : {-1, 1})
            for (int sz : {-1, 1})
                for (int i = 0; i < n; ++i)
                    for (int j = 0; j < n - i; ++j) {
                        const auto at = [&](int a, int b) { return node(Vector3d(sx * a, sy * b, sz * (n - a - b))); };
                        const auto add = [&](int a, int b, int c) {
                            if (sx * sy * sz > 0) s.faces.push_back({a, b, c});
                            else s.faces.push_back({a, c, b});
                        };
                        add(at(i, j), at(i + 1, j), at(i, j + 1));
                        if (i + j < n - 1) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                    }
    return s;
}

inline Segmentation sphere_in_octants(int n, double radius) {
    const Surface s = octasphere(n, radius);
    std::vector<int> label;
    for (int f = 0; f < s.n_faces(); ++f) {
        const Vector3d c = arcsim::face_centroid(s, f);
        label.push_back((c.x() > 0) + 2 * (c.y() > 0) + 4 * (c.z() > 0));
    }
    return cut_by_labels(s, label);
}

/// A closed sphere from a cube, each of whose six sides is cut into four: 24 pieces, 48 seams.
inline Segmentation sphere_in_24(int n, double radius) {
    Surface s;
    std::vector<int> label;
    std::map<std::array<int, 3>, int> known;
    const auto node = [&](const std::array<int, 3>& p) {
        const auto [it, fresh] = known.try_emplace(p, s.n_nodes());
        if (fresh) s.x.push_back(radius * Vector3d(std::tan(M_PI / 4 * p[0] / n), std::tan(M_PI / 4 * p[1] / n), std::tan(M_PI / 4 * p[2] / n)).normalized());
        return it->second;
    };
    for (int axis = 0; axis < 3; ++axis)
        for (int sign : {-1, 1})
            for (int i = -n; i < n; ++i)
                for (int j = -n; j < n; ++j) {
                    const auto at = [&](int a, int b) {
                        std::array<int, 3> p{};
                        p[axis] = sign * n, p[(axis + 1) % 3] = sign > 0 ? a : b, p[(axis + 2) % 3] = sign > 0 ? b : a;
                        return node(p);
                    };
                    s.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                    s.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
                    label.insert(label.end(), 2, 4 * (2 * axis + (sign > 0)) + 2 * (i >= 0) + (j >= 0));
                }
    return cut_by_labels(s, label);
}

/// A tube around z, open at both ends, its radius a function of the height share; cut into strips along the
/// given shares of the circumference (ascending, first one 0). The weave follows the axis.
inline Segmentation tube_in_strips(int around, int along, double height, const std::function<double(double)>& radius,
                                   const std::vector<double>& shares) {
    Surface s;
    for (int j = 0; j <= along; ++j)
        for (int i = 0; i < around; ++i) {
            const double a = 2 * M_PI * i / around, r = radius(double(j) / along);
            s.x.emplace_back(r * std::cos(a), r * std::sin(a), height * j / along);
        }
    std::vector<int> label;
    for (int j = 0; j < along; ++j)
        for (int i = 0; i < around; ++i) {
            const int a = j * around + i, b = j * around + (i + 1) % around;
            s.faces.push_back({a, b, b + around});
            s.faces.push_back({a, b + around, a + around});
            int strip = 0;
            while (strip + 1 < static_cast<int>(shares.size()) && (i + 0.5) / around > shares[strip + 1]) ++strip;
            label.insert(label.end(), 2, strip);
        }
    Segmentation cut = cut_by_labels(s, label);
    for (int f = 0; f < s.n_faces(); ++f) {
        const double theta = arcsim::face_frame(s, f).angle(Vector3d::UnitZ());
        cut.direction[f] = {theta, 1.08, 1.02, 1};
        cut.field_theta[f] = theta;
    }
    return cut;
}

}  // namespace cut_surfaces
