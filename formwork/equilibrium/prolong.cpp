#include "formwork/equilibrium/prolong.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

namespace formwork {
namespace {

using arcsim::Surface;
using arcsim::Triangle;
using arcsim::Vector2d;
using arcsim::Vector3d;

/// u(xi) = value + coefficients (xi, eta, xi² / 2, xi eta, eta² / 2), xi and eta in the node's tangent plane.
struct Quadratic {
    Vector3d e1, e2, origin, value;
    Eigen::Matrix<double, 3, 5> coefficients;

    Eigen::Matrix<double, 5, 1> terms(const Vector3d& x) const {
        const double a = (x - origin).dot(e1), b = (x - origin).dot(e2);
        return (Eigen::Matrix<double, 5, 1>() << a, b, 0.5 * a * a, a * b, 0.5 * b * b).finished();
    }
    Vector3d at(const Vector3d& x) const { return value + coefficients * terms(x); }
};

struct Rings {
    explicit Rings(const Surface& s) : next(s.x.size()), faces(s.x.size()), normal(s.x.size(), Vector3d::Zero()) {
        for (int f = 0; f < s.n_faces(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int a = s.faces[f][k];
                faces[a].push_back(f);
                normal[a] += area_vector(s, f);
                for (int b : s.faces[f])
                    if (b != a && std::find(next[a].begin(), next[a].end(), b) == next[a].end()) next[a].push_back(b);
            }
    }
    std::vector<std::vector<int>> next, faces;
    std::vector<Vector3d> normal;
};

Quadratic fit(const Surface& s, const Rings& rings, const std::vector<Vector3d>& u, int i, std::vector<int>& nodes) {
    Quadratic q;
    q.origin = s.x[i];
    q.value = u[i];
    const Vector3d n = rings.normal[i].normalized();
    q.e1 = n.unitOrthogonal();
    q.e2 = n.cross(q.e1);
    nodes = rings.next[i];
    for (int a : rings.next[i])
        for (int b : rings.next[a])
            if (b != i && std::find(nodes.begin(), nodes.end(), b) == nodes.end()) nodes.push_back(b);
    double h2 = 0;
    for (int a : rings.next[i]) h2 = std::max(h2, (s.x[a] - s.x[i]).squaredNorm());
    const double h = std::sqrt(h2);
    const Eigen::Matrix<double, 5, 1> scale(h, h, h2, h2, h2);   // makes the terms dimensionless
    Eigen::Matrix<double, 5, 5> A = 1e-6 * Eigen::Matrix<double, 5, 5>::Identity();   // keeps sparse rings solvable
    Eigen::Matrix<double, 5, 3> b = Eigen::Matrix<double, 5, 3>::Zero();
    for (int a : nodes) {
        const Eigen::Matrix<double, 5, 1> t = q.terms(s.x[a]).cwiseQuotient(scale);
        const double weight = h2 / (h2 + (s.x[a] - s.x[i]).squaredNorm());   // near nodes count more
        A += weight * t * t.transpose();
        b += weight * t * (u[a] - u[i]).transpose();
    }
    q.coefficients = A.ldlt().solve(b).transpose() * scale.cwiseInverse().asDiagonal();
    return q;
}

/// Barycentric weights of the point of the face next to x, by projection; weights that would be negative are cut.
Vector3d weights_in(const Surface& s, int f, const Vector3d& x, double& distance2) {
    const Triangle& t = s.faces[f];
    const Vector3d a = s.x[t[1]] - s.x[t[0]], b = s.x[t[2]] - s.x[t[0]], d = x - s.x[t[0]];
    const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b), det = aa * bb - ab * ab;
    Vector3d w(1. / 3, 1. / 3, 1. / 3);
    if (det > 0) {
        w[1] = (bb * d.dot(a) - ab * d.dot(b)) / det;
        w[2] = (aa * d.dot(b) - ab * d.dot(a)) / det;
        w[0] = 1 - w[1] - w[2];
        w = w.cwiseMax(0);
        w /= w.sum();
    }
    distance2 = (d - w[1] * a - w[2] * b).squaredNorm();
    return w;
}

}  // namespace

std::vector<Vector3d> prolong(const CoarseMesh& coarse, const std::vector<Vector3d>& u, const Surface& fine,
                              Interpolation interpolation) {
    const Surface& s = coarse.surface;
    const Rings rings(s);
    std::vector<Quadratic> local;
    local.reserve(s.x.size());
    std::vector<int> nodes;
    const bool quadratic = interpolation == Interpolation::quadratic;
    for (int i = 0; quadratic && i < s.n_nodes(); ++i) local.push_back(fit(s, rings, u, i, nodes));

    std::vector<Vector3d> out(fine.x.size(), Vector3d::Zero());
    for (std::size_t i = 0; i < out.size(); ++i) {
        const int home = coarse.absorber[i];
        if (home < 0) continue;                            // a node without faces
        if (coarse.fine_node[home] == static_cast<int>(i)) {
            out[i] = u[home];
            continue;
        }
        double nearest = std::numeric_limits<double>::infinity();
        int face = -1;
        Vector3d w = Vector3d::Zero();
        const auto look = [&](int node) {
            for (int f : rings.faces[node]) {
                double d2 = 0;
                const Vector3d there = weights_in(s, f, fine.x[i], d2);
                if (d2 < nearest) nearest = d2, face = f, w = there;
            }
        };
        look(home);
        if (w.minCoeff() == 0)                             // on the ring's border: perhaps outside of it
            for (int node : rings.next[home]) look(node);
        for (int k = 0; k < 3; ++k)
            if (const int node = s.faces[face][k]; w[k] > 0)
                out[i] += w[k] * (quadratic ? local[node].at(fine.x[i]) : u[node]);
    }
    return out;
}

}  // namespace formwork
