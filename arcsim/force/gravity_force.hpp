#pragma once

#include "arcsim/force/force.hpp"

namespace arcsim {

/// Weight: f_i = m_i g, E = -sum m_i g . x_i.
class GravityForce final : public Force {
public:
    /// @param mass  lumped, kg, per node   @param gravity  m/s²
    GravityForce(VectorXd mass, const Vector3d& gravity) : mass_(std::move(mass)), gravity_(gravity) {}

    std::string_view name() const override { return "gravity"; }
    std::optional<double> energy(const State& s) const override {
        double energy = 0;
        for (int i = 0; i < mass_.size(); ++i) energy -= mass_[i] * gravity_.dot(s.x.segment<3>(3 * i));
        return energy;
    }
    void add_gradient(const State&, VectorXd& g) const override {
        for (int i = 0; i < mass_.size(); ++i) g.segment<3>(3 * i) -= mass_[i] * gravity_;
    }
    void add_hessian(const State&, Tangent, BlockMatrix&) const override {}

private:
    VectorXd mass_;
    Vector3d gravity_;
};

}  // namespace arcsim
