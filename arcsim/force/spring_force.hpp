#pragma once

#include "arcsim/force/cloth_force.hpp"

namespace arcsim {

/// Handles as ArcSim has them: every held node is drawn to its target by three springs, every glued pair
/// together.
///
///   E = 1/2 kappa |x_i - target|²,   E = 1/2 kappa |x_i - x_j|²
///
/// Both are exact potentials with constant, definite tangents. Targets change from step to step.
class SpringForce final : public ClothForce {
public:
    struct Target {
        int node;
        double stiffness;   // kappa, N/m; 0 while the handle is not active
        Vector3d position;  // m
    };
    struct Pair {
        int i, j;
        double stiffness;   // N/m
    };

    /// All pairs that may ever be active: the matrix needs places for them.
    void reserve_pairs(std::vector<std::array<int, 2>> pairs) { all_pairs_ = std::move(pairs); }
    void set(std::vector<Target> targets, std::vector<Pair> pairs) {
        targets_ = std::move(targets);
        pairs_ = std::move(pairs);
    }
    std::vector<Target>& targets() { return targets_; }
    std::vector<Pair>& pairs() { return pairs_; }

    std::string_view name() const override { return "handles"; }
    std::optional<double> energy(const State& s) const override;
    void add_gradient(const State& s, VectorXd& g) const override;
    void add_hessian(const State& s, Tangent t, BlockMatrix& H) const override;
    double frozen_energy(const State& s) const override { return *energy(s); }
    void add_step(const State& s, double h, VectorXd& f, BlockMatrix& A) const override;
    void add_damping(const State&, BlockMatrix&) const override {}   // springs are not damped
    void list_pairs(std::vector<std::array<int, 2>>& pairs) const override {
        pairs.insert(pairs.end(), all_pairs_.begin(), all_pairs_.end());
    }

private:
    void add_scaled_hessian(double factor, BlockMatrix& H) const;

    std::vector<std::array<int, 2>> all_pairs_;
    std::vector<Target> targets_;
    std::vector<Pair> pairs_;
};

}  // namespace arcsim
