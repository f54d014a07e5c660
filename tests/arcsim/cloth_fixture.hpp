#pragma once

#include <map>
#include <random>
#include <string>

#include "arcsim/force/cloth_model.hpp"

/// A small irregular sheet with its states, for tests of forces and steps.

inline arcsim::StretchingRows woven_rows() {
    using K = arcsim::Stiffness4;
    return {K(36496.94, 17.77, 56329.3, 3171.91),   K(453939.78, 24.67, 499773.53, 10794.15),
            K(321081.07, 37.87, 643526.19, 46434.4), K(147439.0, 11.5, 261801.58, 13953.55),
            K(439895.04, 52.62, 383126.43, 12605.24), K(418775.97, 82.44, 488043.68, 44474.28)};
}
inline arcsim::StretchingRows constant_rows() {
    arcsim::StretchingRows r;
    r.fill({300, 2, 250, 37.5});
    return r;
}
inline arcsim::BendingRows bending_rows() {
    return {{{1e-4, 2e-4, 3e-4, 3e-4, 3e-4}, {2e-4, 2e-4, 2e-4, 5e-4, 6e-4}, {3e-4, 3e-4, 4e-4, 4e-4, 4e-4}}};
}

struct Patch {
    static constexpr int n = 4;                     // nodes per side, 1 cm apart
    std::vector<arcsim::Vector2d> u;
    std::vector<arcsim::Triangle> faces;

    Patch() {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> jitter(-0.002, 0.002);
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) u.emplace_back(0.01 * i + jitter(random), 0.01 * j + jitter(random));
        for (int j = 0; j + 1 < n; ++j)
            for (int i = 0; i + 1 < n; ++i) {
                const int a = j * n + i, b = a + 1, c = a + n + 1, d = a + n;
                if ((i + j) % 2 == 0) faces.insert(faces.end(), {{a, b, c}, {a, c, d}});
                else faces.insert(faces.end(), {{a, b, d}, {b, c, d}});
            }
    }

    std::vector<arcsim::StretchFace> stretch_faces(double damping) const {
        std::vector<arcsim::StretchFace> r;
        for (const auto& t : faces) {
            arcsim::Matrix2d D;
            D << u[t[1]] - u[t[0]], u[t[2]] - u[t[0]];
            r.push_back({t, D.inverse(), 0.5 * D.determinant(), damping, 1, 0});
        }
        return r;
    }

    std::vector<arcsim::Hinge> hinges(double damping) const {
        std::vector<arcsim::Hinge> r;
        const auto area = stretch_faces(0);
        for (size_t f = 0; f < faces.size(); ++f)
            for (size_t g = f + 1; g < faces.size(); ++g)
                for (int k = 0; k < 3; ++k)
                    for (int l = 0; l < 3; ++l)
                        if (faces[f][k] == faces[g][(l + 1) % 3] && faces[f][(k + 1) % 3] == faces[g][l]) {
                            const int a = faces[f][k], b = faces[f][(k + 1) % 3];
                            const arcsim::Vector2d e = u[a] - u[b];
                            const double d = arcsim::BendingTable::direction(e);
                            r.push_back({{a, b, faces[f][(k + 2) % 3], faces[g][(l + 2) % 3]}, e.norm(),
                                         area[f].area + area[g].area, 0, damping, 1, {d, d}, {0, 0}});
                        }
        return r;
    }

    /// At rest, stretched, sheared, compressed, folded sharply, and bent at random.
    std::map<std::string, arcsim::State> states() const {
        std::mt19937 random(11);
        std::uniform_real_distribution<double> jitter(-1, 1);
        const auto make = [&](auto&& map, double noise) {
            arcsim::State s;
            s.x.resize(3 * static_cast<int>(u.size()));
            s.v = arcsim::VectorXd::Zero(s.x.size());
            for (size_t i = 0; i < u.size(); ++i) {
                arcsim::Vector3d p = map(u[i]);
                for (double& c : p) c += noise * jitter(random);
                s.x.segment<3>(3 * static_cast<int>(i)) = p;
            }
            return s;
        };
        using arcsim::Vector2d;
        using arcsim::Vector3d;
        std::map<std::string, arcsim::State> r;
        r["rest"] = make([](Vector2d p) { return Vector3d(p.x(), p.y(), 0); }, 0);
        r["stretched"] = make([](Vector2d p) { return Vector3d(1.08 * p.x(), 1.03 * p.y(), 0.002 * p.x()); }, 2e-4);
        r["sheared"] = make([](Vector2d p) { return Vector3d(p.x() + 0.3 * p.y(), p.y(), 0); }, 2e-4);
        r["compressed"] = make([](Vector2d p) { return Vector3d(0.8 * p.x(), 0.9 * p.y(), 0); }, 2e-4);
        r["folded"] = make([](Vector2d p) {
            const double s = p.x() - 0.015;             // folds by 150 degrees along the middle
            return s < 0 ? Vector3d(s, p.y(), 0) : Vector3d(-0.866 * s, p.y(), 0.5 * s);
        }, 3e-4);
        r["bent"] = make([](Vector2d p) { return Vector3d(p.x(), p.y(), 20 * p.x() * p.x()); }, 5e-4);
        return r;
    }
};

/// The patch as a cloth: 0.2 kg/m², no air, at `x`.
inline arcsim::ClothModel patch_model(const Patch& patch, const arcsim::StretchingRows& rows, const arcsim::VectorXd& x,
                                      const arcsim::Vector3d& gravity = {0, 0, 0}, double damping = 0,
                                      double air_density = 0) {
    using namespace arcsim;
    ClothModel m;
    m.faces = patch.faces;
    m.size = 0.03;
    m.mass = VectorXd::Zero(static_cast<int>(patch.u.size()));
    std::vector<WindForce::Face> wind;
    for (const StretchFace& f : patch.stretch_faces(0)) {
        for (int node : f.node) m.mass[node] += 0.2 * f.area / 3;
        wind.push_back({f.node, f.area});
    }
    m.gravity = std::make_unique<GravityForce>(m.mass, gravity);
    m.stretch = std::make_unique<StretchForce>(
        patch.stretch_faces(damping), std::vector{std::shared_ptr<const StiffnessTable>(
                                          std::make_shared<StiffnessTable>(rows, Sampling::exact))});
    m.bend = std::make_unique<BendForce>(patch.hinges(damping), std::vector{BendingTable(bending_rows())}, x);
    m.wind = std::make_unique<WindForce>(wind, air_density, 0.1 * air_density, Vector3d(1, 2, 3), x);
    return m;
}
