#include "arcsim/force/spring_force.hpp"

namespace arcsim {

std::optional<double> SpringForce::energy(const State& s) const {
    double energy = 0;
    for (const Target& t : targets_)
        energy += 0.5 * t.stiffness * (s.x.segment<3>(3 * t.node) - t.position).squaredNorm();
    for (const Pair& p : pairs_)
        energy += 0.5 * p.stiffness * (s.x.segment<3>(3 * p.i) - s.x.segment<3>(3 * p.j)).squaredNorm();
    return energy;
}

void SpringForce::add_gradient(const State& s, VectorXd& g) const {
    for (const Target& t : targets_)
        g.segment<3>(3 * t.node) += t.stiffness * (s.x.segment<3>(3 * t.node) - t.position);
    for (const Pair& p : pairs_) {
        const Vector3d pull = p.stiffness * (s.x.segment<3>(3 * p.i) - s.x.segment<3>(3 * p.j));
        g.segment<3>(3 * p.i) += pull;
        g.segment<3>(3 * p.j) -= pull;
    }
}

void SpringForce::add_hessian(const State&, Tangent, BlockMatrix& H) const { add_scaled_hessian(1, H); }

void SpringForce::add_scaled_hessian(double factor, BlockMatrix& H) const {
    for (const Target& t : targets_) H.add_to_diagonal(t.node, factor * t.stiffness);
    for (const Pair& p : pairs_) {
        const double k = factor * p.stiffness;
        H.add_to_diagonal(p.i, k);
        H.add_to_diagonal(p.j, k);
        H.add(H.pattern().slot(p.i, p.j), -k * Matrix3d::Identity());
    }
}

void SpringForce::add_step(const State& s, double h, VectorXd& f, BlockMatrix& A) const {
    for (const Target& t : targets_)
        f.segment<3>(3 * t.node) -= t.stiffness * (s.x.segment<3>(3 * t.node) - t.position);
    for (const Pair& p : pairs_) {
        const Vector3d pull = p.stiffness * (s.x.segment<3>(3 * p.i) - s.x.segment<3>(3 * p.j));
        f.segment<3>(3 * p.i) -= pull;
        f.segment<3>(3 * p.j) += pull;
    }
    add_scaled_hessian(h * h, A);
}

}  // namespace arcsim
