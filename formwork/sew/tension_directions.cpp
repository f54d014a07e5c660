#include "formwork/sew/tension_directions.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "formwork/fabric/membrane_law.hpp"

namespace formwork {
namespace {

double stretch_along(const Vector3d& eps, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return std::sqrt(std::max(1 + 2 * (c * c * eps[0] + s * s * eps[1] + 2 * c * s * eps[2]), 0.0));
}

}  // namespace

std::vector<DirectionData> tension_directions(const Surface& surface, const SewResult& sewn, const MaterialParams& material) {
    const std::unique_ptr<MembraneLaw> law = make_membrane_law(material);
    std::vector<DirectionData> directions;
    double largest = 0;
    for (int f = 0; f < surface.n_faces(); ++f) {
        const FaceStrain& e = sewn.equilibrium.strain[f];
        const Vector3d eps(e.eps_uu, e.eps_vv, e.eps_uv), fabric = law->fabric_strain(eps);
        const Vector3d S = evaluate_one(*law, eps, Want::stress).S;
        const double angle = 0.5 * std::atan2(2 * S[2], S[0] - S[1]);
        const FlatTriangle& u = sewn.bag.flat[f];
        const Triangle& t = surface.faces[f];
        arcsim::Matrix2d flat;
        flat << u[1] - u[0], u[2] - u[0];
        Matrix32d shape;
        shape << surface.x[t[1]] - surface.x[t[0]], surface.x[t[2]] - surface.x[t[0]];
        const Vector3d d = shape * flat.inverse() * Vector2d(std::cos(angle), std::sin(angle));
        directions.push_back({arcsim::face_frame(surface, f).angle(d), stretch_along(fabric, angle), stretch_along(fabric, angle + M_PI / 2),
                              std::hypot(S[0] - S[1], 2 * S[2])});
        largest = std::max(largest, directions.back().weight);
    }
    if (largest > 0)
        for (DirectionData& d : directions) d.weight /= largest;
    return directions;
}

}  // namespace formwork
