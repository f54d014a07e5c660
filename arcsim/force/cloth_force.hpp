#pragma once

#include "arcsim/force/force.hpp"

namespace arcsim {

/// A force of the cloth itself, as ArcSim's step treats it: table stiffnesses are held fixed while it is
/// differentiated, and each element has a stiffness-proportional damping beta (s), whose force is beta J v.
class ClothForce : public Force {
public:
    /// J, with the table values of this state: what the start relaxation minimises. Its gradient with those
    /// values held fixed is the force.
    virtual double frozen_energy(const State& s) const = 0;

    /// One pass of the linearly implicit step: f += force, A += h (h + beta) H with H the definite tangent.
    virtual void add_step(const State& s, double h, VectorXd& f, BlockMatrix& A) const = 0;

    /// H += beta times the definite tangent, N s/m.
    virtual void add_damping(const State& s, BlockMatrix& H) const = 0;

    /// Called with the positions before they move: what the next step looks up with a lag of one step.
    virtual void refresh(const VectorXd& x) { static_cast<void>(x); }
};

}  // namespace arcsim
