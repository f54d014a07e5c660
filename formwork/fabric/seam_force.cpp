#include "formwork/fabric/seam_force.hpp"

#include <algorithm>

namespace formwork {
namespace {

bool is_slack(const SeamSpring& e, double length) { return e.goes_slack && length <= e.L; }

}  // namespace

using arcsim::Matrix3d;
using arcsim::State;
using arcsim::Vector3d;
using arcsim::VectorXd;

std::optional<double> SeamForce::energy(const State& s) const {
    double E = 0;
    for (const SeamSpring& e : springs_) {
        const double longer = (s.x.segment<3>(3 * e.j) - s.x.segment<3>(3 * e.i)).norm() - e.L;
        if (is_slack(e, longer + e.L)) continue;
        E += 0.5 * e.kappa * longer * longer;
    }
    return E;
}

void SeamForce::add_gradient(const State& s, VectorXd& g) const {
    for (const SeamSpring& e : springs_) {
        const Vector3d d = s.x.segment<3>(3 * e.j) - s.x.segment<3>(3 * e.i);
        const double l = d.norm();
        if (is_slack(e, l)) continue;
        const Vector3d t = e.L == 0 ? Vector3d(e.kappa * d) : l > 0 ? Vector3d(e.kappa * (1 - e.L / l) * d) : Vector3d::Zero();
        g.segment<3>(3 * e.i) -= t;
        g.segment<3>(3 * e.j) += t;
    }
}

void SeamForce::add_hessian(const State& s, arcsim::Tangent t, arcsim::BlockMatrix& H) const {
    for (std::size_t k = 0; k < springs_.size(); ++k) {
        const SeamSpring& e = springs_[k];
        const Vector3d d = s.x.segment<3>(3 * e.j) - s.x.segment<3>(3 * e.i);
        const double l = d.norm();
        if (is_slack(e, l)) continue;
        Matrix3d K = e.kappa * Matrix3d::Identity();
        if (e.L > 0 && l > 0) {
            const Matrix3d along = d * d.transpose() / (l * l);
            double across = 1 - e.L / l;
            if (t == arcsim::Tangent::definite) across = std::max(across, 0.0);
            K = e.kappa * (across * (Matrix3d::Identity() - along) + along);
        }
        H.add_diagonal(e.i, K);
        H.add_diagonal(e.j, K);
        H.add(slots_[k], -K);
    }
}

void SeamForce::list_pairs(std::vector<std::array<int, 2>>& pairs) const {
    for (const SeamSpring& e : springs_) pairs.push_back({e.i, e.j});
}

void SeamForce::bind(const arcsim::BlockPattern& p) {
    slots_.clear();
    for (const SeamSpring& e : springs_) slots_.push_back(p.slot(e.i, e.j));
}

double SeamForce::max_tension(const VectorXd& x) const {
    double most = 0;
    for (const SeamSpring& e : springs_)
        most = std::max(most, e.kappa * ((x.segment<3>(3 * e.j) - x.segment<3>(3 * e.i)).norm() - e.L));
    return most;
}

bool SeamForce::may_push() const {
    return std::any_of(springs_.begin(), springs_.end(), [](const SeamSpring& s) { return s.L > 0 && !s.goes_slack; });
}

double SeamForce::largest_stiffness() const {
    double most = 0;
    for (const SeamSpring& e : springs_) most = std::max(most, e.kappa);
    return most;
}

}  // namespace formwork
