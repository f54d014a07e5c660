#pragma once

#include <memory>
#include <vector>

#include "arcsim/force/bend_force.hpp"
#include "arcsim/force/gravity_force.hpp"
#include "arcsim/force/spring_force.hpp"
#include "arcsim/force/strain_limit_force.hpp"
#include "arcsim/force/stretch_force.hpp"
#include "arcsim/force/wind_force.hpp"

namespace arcsim {

/// A node that is held exactly, and where it has to be at the end of the step, m.
struct HeldNode {
    int node;
    Vector3d target;
};

/// One cloth with everything that acts on it. Cloths do not touch, so each is stepped by itself.
struct ClothModel {
    std::vector<Triangle> faces;
    double size = 0;                     // longest side of the start pose's box, m
    VectorXd mass;                       // lumped, kg, per node; a third of each face's
    std::unique_ptr<StretchForce> stretch;
    std::unique_ptr<BendForce> bend;
    std::unique_ptr<GravityForce> gravity;
    std::unique_ptr<WindForce> wind;
    std::unique_ptr<StrainLimitForce> limits;   // null: the scene names none
    SpringForce springs;
    std::vector<HeldNode> held;

    int n_nodes() const { return static_cast<int>(mass.size()); }
    std::vector<ClothForce*> internal_forces() const { return {stretch.get(), bend.get()}; }

    /// `refresh` at the positions at which the forces have just added a step.
    void refresh_after_step(const VectorXd& x) {
        stretch->refresh(x);
        bend->keep_step_angles();
        wind->refresh(x);
    }
    /// Everything that is looked up with a lag of one step.
    void refresh(const VectorXd& x) {
        stretch->refresh(x);
        bend->refresh(x);
        wind->refresh(x);
    }
};

}  // namespace arcsim
