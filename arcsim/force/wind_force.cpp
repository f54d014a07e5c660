#include "arcsim/force/wind_force.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace arcsim {

WindForce::WindForce(std::vector<Face> faces, double density, double drag, const Vector3d& velocity,
                     const VectorXd& x)
    : faces_(std::move(faces)), normals_(faces_.size(), Vector3d::Zero()), density_(density), drag_(drag), velocity_(velocity) {
    refresh(x);
}

void WindForce::refresh(const VectorXd& x) {
    if (!acts()) return;
    for (size_t f = 0; f < faces_.size(); ++f) {
        const Triangle& t = faces_[f].node;
        const Vector3d x0 = x.segment<3>(3 * t[0]);
        normals_[f] = (x.segment<3>(3 * t[1]) - x0).cross(x.segment<3>(3 * t[2]) - x0).stableNormalized();
    }
}

Vector3d WindForce::relative_velocity(const State& s, const Face& f) const {
    const Vector3d sum = s.v.segment<3>(3 * f.node[0]) + s.v.segment<3>(3 * f.node[1]) + s.v.segment<3>(3 * f.node[2]);
    return velocity_ - sum / 3;
}

void WindForce::add_gradient(const State& s, VectorXd& g) const {
    if (!acts()) return;
    for (size_t i = 0; i < faces_.size(); ++i) {
        const Face& f = faces_[i];
        const Vector3d& n = normals_[i];
        const Vector3d w = relative_velocity(s, f);
        const double normal_part = n.dot(w);
        const Vector3d force = f.area * (density_ * std::abs(normal_part) * normal_part * n + drag_ * (w - normal_part * n));
        for (int node : f.node) g.segment<3>(3 * node) -= force / 3;
    }
}

void WindForce::add_velocity_hessian(const State& s, BlockMatrix& H) const {
    if (!acts()) return;
    for (size_t i = 0; i < faces_.size(); ++i) {
        const Face& f = faces_[i];
        const Matrix3d nn = normals_[i] * normals_[i].transpose();
        const double normal_part = normals_[i].dot(relative_velocity(s, f));
        // d(-F_i)/dv_j: a third of the force per corner, a third of each corner's velocity.
        const Matrix3d B = f.area / 9 * (2 * density_ * std::abs(normal_part) * nn + drag_ * (Matrix3d::Identity() - nn));
        for (int k = 0; k < 3; ++k) {
            H.add_diagonal(f.node[k], B);
            H.add(pattern_->slot(f.node[k], f.node[(k + 1) % 3]), B);
        }
    }
}

}  // namespace arcsim
