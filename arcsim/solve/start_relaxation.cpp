#include "arcsim/solve/start_relaxation.hpp"

#include <cmath>

#include "arcsim/base/error.hpp"

namespace arcsim {

int relax_start(ClothSystem& system, VectorXd& x) {
    constexpr int max_steps = 10;
    constexpr double smallest_drop = 1e-12;   // J; ArcSim's outputs bracket it between 8e-14 and 1.5e-11
    ClothModel& model = system.model();
    const VectorXd start = x;
    State s{x, VectorXd::Zero(x.size()), 0};
    const auto energy = [&](const VectorXd& at) {
        s.x = at;
        double e = 0.5 * (at - start).squaredNorm();
        for (const ClothForce* force : model.internal_forces()) e += force->frozen_energy(s);
        return e;
    };
    double before = energy(x);
    VectorXd g, dx;
    for (int step = 0; step < max_steps; ++step) {
        s.x = x;
        g = x - start;
        system.matrix().set_zero();
        for (const ClothForce* force : model.internal_forces())
            force->add_gradient_and_hessian(s, Tangent::definite, g, system.matrix());
        for (int i = 0; i < model.n_nodes(); ++i) system.matrix().add_to_diagonal(i, 1);
        if (!system.solver().try_factorize(system.matrix()))
            throw NumericalError("start relaxation: the matrix is not positive definite at node " +
                                 std::to_string(system.solver().breakdown().node) +
                                 ". Check the material: k_uv² must not exceed k_uu k_vv.");
        system.solver().solve(-g, dx);
        double after = energy(x + dx);
        for (int halving = 0; !(after <= before) && halving < 20; ++halving) {
            dx *= 0.5;
            after = energy(x + dx);
        }
        if (!(before - after >= smallest_drop)) return step;
        x += dx;
        before = after;
    }
    return max_steps;
}

}  // namespace arcsim
