#include "tests/formwork/synthetic_bag.hpp"

#include <algorithm>
#include <cmath>
#include <map>

using namespace formwork;

namespace {

constexpr double height = 0.30, radius = 0.045;

/// @param s   0 at the middle of the bottom .. 1 at its edge, then up the wall: 1 .. 2     @param a
/// angle
Vector3d place(double s, double a, double swell) {
    const double z = s < 1 ? 0 : height * (s - 1), t = z / height;
    const double twist = 0.9 * t, c = std::cos(a), d = std::sin(a);
    const double square = std::pow(std::pow(std::abs(c), 4) + std::pow(std::abs(d), 4), -0.25);
    const double belly = swell * (0.35 * std::sin(M_PI * t) * (1.3 - t) + 0.08 * (1 - t));
    const double r =
        std::min(s, 1.0) * radius * (0.5 * square + 0.5) * (1.12 - 0.25 * t) * (1 + belly);
    const double sag = swell * 0.03 * (s < 1 ? 1 - s * s : 0);
    return {r * std::cos(a + twist), r * std::sin(a + twist), z - sag};
}

FlatPanel flatten(const Segmentation& g, int id, const std::vector<Vector2d>& flat) {
    FlatPanel p;
    p.id = id;
    std::map<int, int> local;
    std::map<std::pair<int, int>, int> next;  // border edges: once in this panel
    for (int f = 0; f < g.mesh.n_faces(); ++f) {
        if (g.panel[f] != id) continue;
        Triangle t;
        for (int k = 0; k < 3; ++k) {
            const int node = g.mesh.faces[f][k];
            const auto [it, is_new] = local.try_emplace(node, static_cast<int>(local.size()));
            if (is_new) {
                p.node.push_back(node);
                Vector2d u = flat[node];
                if (id < 4) {  // the wall's angle jumps somewhere: keep each side in one piece
                    const double side = 2 * M_PI * radius / 4;
                    u.y() = std::remainder(u.y() - (id + 0.5) * side, 4 * side);
                } else if (u.x() == 0) {
                    u = g.mesh.x[node].head<2>();
                }
                p.u.push_back(Vector2d(u.x(), -u.y()));  // seen from outside
            }
            t[k] = it->second;
        }
        p.face.push_back(f);
        p.faces.push_back(t);
        for (int k = 0; k < 3; ++k) next[{t[k], t[(k + 1) % 3]}] = 1;
    }
    std::map<int, int> border;
    for (const auto& [e, one] : next)
        if (one && !next.count({e.second, e.first})) border[e.first] = e.second;
    for (int i = border.begin()->first, k = 0; k < static_cast<int>(border.size());
         ++k, i = border[i])
        p.boundary.push_back(i);
    p.area = p.rest_area = 0.01;
    p.max_stretch_distortion = 0.01 * (id + 1);
    return p;
}

}  // namespace

SyntheticBag make_synthetic_bag(int around, int up) {
    SyntheticBag bag;
    Segmentation& g = bag.segmentation;
    const int inner = std::max(2, around / 8),
              rows = inner + up;  // rings of the bottom, then of the wall
    std::vector<Vector2d> flat;
    const auto add = [&](double s, double a) {
        g.mesh.x.push_back(place(s, a, 0));
        bag.inflated.x.push_back(place(s, a, 1));
        bag.sewn.x.push_back(place(s, a, 0.5));
        bag.deviation.push_back((bag.sewn.x.back() - g.mesh.x.back()).norm() * std::cos(3 * a));
        flat.push_back(s < 1 ? Vector2d(place(s, a, 0).head<2>())
                             : Vector2d(height * (s - 1), a * radius));
        return static_cast<int>(g.mesh.x.size()) - 1;
    };
    const int middle = add(0, 0);
    std::vector<std::vector<int>> ring;
    for (int r = 1; r <= rows; ++r) {
        ring.emplace_back();
        for (int k = 0; k < around; ++k)
            ring.back().push_back(add(r <= inner ? double(r) / inner : 1 + double(r - inner) / up,
                                      2 * M_PI * k / around));
    }
    const auto face = [&](int a, int b, int c, int panel) {
        g.mesh.faces.push_back({a, b, c});
        g.panel.push_back(panel);
    };
    for (int k = 0; k < around; ++k) face(middle, ring[0][(k + 1) % around], ring[0][k], 4);
    for (int r = 0; r + 1 < rows; ++r)
        for (int k = 0; k < around; ++k) {
            const int a = ring[r][k], b = ring[r][(k + 1) % around], c = ring[r + 1][k],
                      d = ring[r + 1][(k + 1) % around];
            const int panel = r + 1 < inner ? 4 : 4 * k / around;
            face(a, b, d, panel);
            face(a, d, c, panel);
        }
    g.n_panels = 5;
    for (int q = 0; q < 4; ++q) {
        Seam wall, foot, rim;
        for (int r = inner - 1; r < rows; ++r) wall.nodes.push_back(ring[r][q * around / 4]);
        for (int k = 0; k <= around / 4; ++k) {
            foot.nodes.push_back(ring[inner - 1][(q * around / 4 + k) % around]);
            rim.nodes.push_back(ring[rows - 1][(q * around / 4 + k) % around]);
        }
        wall.panel = {(q + 3) % 4, q};
        foot.panel = {q, 4};
        rim.panel = {q, -1};
        for (Seam* s : {&wall, &foot, &rim}) g.seams.push_back(*s);
        g.singularities.push_back({ring[inner - 1][q * around / 4], 1});
    }
    g.singularities.push_back({ring[rows / 2][around / 8], -1});
    for (int i = 0; i < g.mesh.n_nodes(); ++i) g.source.push_back({});
    bag.inflated.faces = bag.sewn.faces = g.mesh.faces;
    for (int f = 0; f < g.mesh.n_faces(); ++f) {
        g.source_face.push_back(f);
        const arcsim::FaceFrame frame = arcsim::face_frame(g.mesh, f);
        const Vector3d c = arcsim::face_centroid(g.mesh, f);
        Vector3d along = Vector3d(-c.y(), c.x(), 0);  // around the axis; on the bottom: along x
        if (g.panel[f] == 4) along = Vector3d::UnitX();
        FaceStrain s;
        s.lambda1 = std::sqrt(arcsim::face_area(bag.inflated, f) / arcsim::face_area(g.mesh, f));
        s.lambda2 = 1 + 0.3 * (s.lambda1 - 1);
        s.dir = along.normalized();
        s.tension1 = 600 * (s.lambda1 - 1);
        s.eps_uv = 0.04 * std::sin(8 * c.z() / height) * std::cos(2 * std::atan2(c.y(), c.x()));
        s.state = s.lambda1 < 1.02   ? FaceState::slack
                  : s.lambda1 < 1.06 ? FaceState::wrinkled
                                     : FaceState::taut;
        bag.strain.push_back(s);
        s.eps_uv *= 0.2;
        bag.sewn_strain.push_back(s);
        g.direction.push_back(
            {frame.angle(s.dir), s.lambda1, s.lambda2, std::min(1.0, (s.lambda1 - 1) / 0.3)});
        g.field_theta.push_back(frame.angle(s.dir));
    }
    for (int p = 0; p < 5; ++p) bag.panels.push_back(flatten(g, p, flat));
    return bag;
}
