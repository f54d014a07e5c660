#include "tests/formwork/layout_meshes.hpp"

#include <cmath>
#include <map>
#include <numbers>

namespace layout_meshes {
namespace {

using arcsim::Vector3d;
constexpr double tau = 2 * std::numbers::pi;

/// The faces that stay, with only the nodes they use.
Surface keep_faces(const Surface& s, const std::function<bool(const Vector3d&)>& keep) {
    Surface out;
    std::vector<int> number(s.x.size(), -1);
    for (int f = 0; f < s.n_faces(); ++f) {
        if (!keep(arcsim::face_centroid(s, f))) continue;
        arcsim::Triangle t = s.faces[f];
        for (int& v : t) {
            if (number[v] < 0) {
                number[v] = out.n_nodes();
                out.x.push_back(s.x[v]);
            }
            v = number[v];
        }
        out.faces.push_back(t);
    }
    return out;
}

}  // namespace

Surface grid(int nu, int nv, bool closed_u, bool closed_v, const std::function<Vector3d(double, double)>& at) {
    Surface s;
    const int mu = closed_u ? nu : nu + 1, mv = closed_v ? nv : nv + 1;
    for (int j = 0; j < mv; ++j)
        for (int i = 0; i < mu; ++i) s.x.push_back(at(static_cast<double>(i) / nu, static_cast<double>(j) / nv));
    for (int j = 0; j < nv; ++j)
        for (int i = 0; i < nu; ++i) {
            const int a = j * mu + i, b = j * mu + (i + 1) % mu, c = (j + 1) % mv * mu + (i + 1) % mu,
                      d = (j + 1) % mv * mu + i;
            if ((i + j) % 2) {
                s.faces.push_back({a, b, c});
                s.faces.push_back({a, c, d});
            } else {
                s.faces.push_back({a, b, d});
                s.faces.push_back({b, c, d});
            }
        }
    return s;
}

Surface tube(int n_around, int n_along, double radius, double height) {
    return grid(n_around, n_along, true, false, [&](double u, double v) {
        return Vector3d(radius * std::cos(tau * u), radius * std::sin(tau * u), height * v);
    });
}

Surface cup(int n_around, double radius, double height) {
    const int rings = std::max(2, n_around / 6), walls = static_cast<int>(std::lround(height / (tau * radius / n_around)));
    Surface s = grid(n_around, rings + walls, true, false, [&](double u, double v) {
        const double step = v * (rings + walls), r = step < rings ? radius * (step + 0.5) / (rings + 0.5) : radius;
        return Vector3d(r * std::cos(tau * u), r * std::sin(tau * u), step < rings ? 0 : height * (step - rings) / walls);
    });
    const int centre = s.n_nodes();
    s.x.push_back(Vector3d::Zero());
    for (int i = 0; i < n_around; ++i) s.faces.push_back({centre, (i + 1) % n_around, i});
    return s;
}

Surface torus(int n_around, int n_section, double big, double small) {
    return grid(n_around, n_section, true, true, [&](double u, double v) {
        const double r = big + small * std::cos(tau * v);
        return Vector3d(r * std::cos(tau * u), r * std::sin(tau * u), small * std::sin(tau * v));
    });
}

Surface icosphere(int subdivisions, double radius) {
    const double g = (1 + std::sqrt(5.)) / 2;
    Surface s{{{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g},
               {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}},
              {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
               {11, 10, 2}, {10, 7, 6}, {7, 1, 8}, {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8},
               {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}}};
    for (int round = 0; round < subdivisions; ++round) {
        std::map<std::pair<int, int>, int> middle;
        const auto mid = [&](int a, int b) {
            const auto [it, is_new] = middle.try_emplace(std::minmax(a, b), s.n_nodes());
            if (is_new) s.x.push_back(0.5 * (s.x[a] + s.x[b]));
            return it->second;
        };
        std::vector<arcsim::Triangle> faces;
        for (const arcsim::Triangle& t : s.faces) {
            const int a = mid(t[0], t[1]), b = mid(t[1], t[2]), c = mid(t[2], t[0]);
            for (const arcsim::Triangle& u : {arcsim::Triangle{t[0], a, c}, {t[1], b, a}, {t[2], c, b}, {a, b, c}})
                faces.push_back(u);
        }
        s.faces = std::move(faces);
    }
    // Turned, so that nothing lies on an axis by accident.
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    for (Vector3d& x : s.x) x = radius * (turn * x).normalized();
    return s;
}

Surface open_sphere(int subdivisions, double radius, double z) {
    return keep_faces(icosphere(subdivisions, radius), [&](const Vector3d& c) { return c.z() < z; });
}

Surface three_way(int subdivisions, double radius) {
    return keep_faces(icosphere(subdivisions, radius), [&](const Vector3d& c) {
        for (int k = 0; k < 3; ++k) {
            const double a = tau * k / 3;
            if (c.dot(Vector3d(std::cos(a), std::sin(a), 0)) > 0.85 * radius) return false;
        }
        return true;
    });
}

std::vector<DirectionData> along(const Surface& s, const Vector3d& d, double weight) {
    std::vector<DirectionData> data;
    for (int f = 0; f < s.n_faces(); ++f)
        data.push_back({arcsim::face_frame(s, f).angle(d), 1.08, 1.02, weight});
    return data;
}

}  // namespace layout_meshes
