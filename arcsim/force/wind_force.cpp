#include "arcsim/force/wind_force.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace arcsim {

WindForce::WindForce(std::vector<Face> faces, double density, double drag, const Vector3d& velocity,
                     const VectorXd& x)
    : faces_(std::move(faces)), normals_(faces_.size(), Vector3d::Zero()), density_(density), drag_(drag), velocity_(velocity) {
    refresh(x);
}

namespace {

/// Twice the area of a face times its normal.
Vector3d area_vector(const Triangle& t, const VectorXd& x) {
    const Vector3d x0 = x.segment<3>(3 * t[0]);
    return (x.segment<3>(3 * t[1]) - x0).cross(x.segment<3>(3 * t[2]) - x0);
}

Matrix3d cross_matrix(const Vector3d& a) {
    Matrix3d m;
    m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
    return m;
}

}  // namespace

void WindForce::refresh(const VectorXd& x) {
    if (!acts() || follows_) return;
    for (size_t f = 0; f < faces_.size(); ++f) normals_[f] = area_vector(faces_[f].node, x).stableNormalized();
}

Vector3d WindForce::normal(const VectorXd& x, size_t face) const {
    return follows_ ? Vector3d(area_vector(faces_[face].node, x).stableNormalized()) : normals_[face];
}

Vector3d WindForce::relative_velocity(const State& s, const Face& f) const {
    const Vector3d sum = s.v.segment<3>(3 * f.node[0]) + s.v.segment<3>(3 * f.node[1]) + s.v.segment<3>(3 * f.node[2]);
    return velocity_ - sum / 3;
}

void WindForce::add_gradient(const State& s, VectorXd& g) const {
    if (!acts()) return;
    for (size_t i = 0; i < faces_.size(); ++i) {
        const Face& f = faces_[i];
        const Vector3d n = normal(s.x, i);
        const Vector3d w = relative_velocity(s, f);
        const double normal_part = n.dot(w);
        const Vector3d force = f.area * (density_ * std::abs(normal_part) * normal_part * n + drag_ * (w - normal_part * n));
        for (int node : f.node) g.segment<3>(3 * node) -= force / 3;
    }
}

/// With F = A (c n + drag w), c = density |w_n| w_n - drag w_n:
///
///   dF = A (n (2 density |w_n| - drag) w . dn + c dn),   dn = (I - n nᵀ) dN / |N|,   N = e1 x e2
void WindForce::add_hessian(const State& s, Tangent t, BlockMatrix& H) const {
    if (!acts() || !follows_ || t == Tangent::definite) return;
    for (size_t i = 0; i < faces_.size(); ++i) {
        const Face& f = faces_[i];
        const Vector3d N = area_vector(f.node, s.x), w = relative_velocity(s, f);
        const double length = N.norm();
        if (length == 0) continue;
        const Vector3d n = N / length, x0 = s.x.segment<3>(3 * f.node[0]);
        const double normal_part = n.dot(w);
        const Matrix3d by_n = f.area * ((2 * density_ * std::abs(normal_part) - drag_) * n * w.transpose() +
                                        (density_ * std::abs(normal_part) - drag_) * normal_part * Matrix3d::Identity());
        const Matrix3d by_N = by_n * (Matrix3d::Identity() - n * n.transpose()) / length;
        const Matrix3d by_1 = -by_N * cross_matrix(s.x.segment<3>(3 * f.node[2]) - x0);   // dN = dx1 x e2 + e1 x dx2
        const Matrix3d by_2 = by_N * cross_matrix(s.x.segment<3>(3 * f.node[1]) - x0);
        const Matrix3d B[3] = {(by_1 + by_2) / 3, -by_1 / 3, -by_2 / 3};                  // -dF_i/dx_j, alike for every i
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3;
            H.add_diagonal(f.node[k], B[k]);
            H.add(pattern_->slot(f.node[k], f.node[next]), B[next], B[k]);
        }
    }
}

void WindForce::add_velocity_hessian(const State& s, BlockMatrix& H) const {
    if (!acts()) return;
    for (size_t i = 0; i < faces_.size(); ++i) {
        const Face& f = faces_[i];
        const Vector3d n = normal(s.x, i);
        const Matrix3d nn = n * n.transpose();
        const double normal_part = n.dot(relative_velocity(s, f));
        // d(-F_i)/dv_j: a third of the force per corner, a third of each corner's velocity.
        const Matrix3d B = f.area / 9 * (2 * density_ * std::abs(normal_part) * nn + drag_ * (Matrix3d::Identity() - nn));
        for (int k = 0; k < 3; ++k) {
            H.add_diagonal(f.node[k], B);
            H.add(pattern_->slot(f.node[k], f.node[(k + 1) % 3]), B);
        }
    }
}

}  // namespace arcsim
