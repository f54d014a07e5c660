#pragma once

#include <memory>

#include "arcsim/base/block_matrix.hpp"
#include "arcsim/force/cloth_model.hpp"
#include "arcsim/solve/fill_order.hpp"
#include "arcsim/solve/linear_solver.hpp"

namespace arcsim {

/// Where the CPU time of the steps went, seconds, summed over a stepper's life.
struct StepCost {
    double assembly = 0, factor = 0, solve = 0, limits = 0, rest = 0;
    int steps = 0, factorizations = 0;
};

/// The matrix of one cloth and its solver: pattern, fill order and symbolic analysis are made once.
class ClothSystem {
public:
    explicit ClothSystem(ClothModel& model, FillOrder order = FillOrder::automatic,
                         SolverKind solver = SolverKind::automatic);

    BlockMatrix& matrix() { return *A_; }
    const BlockPattern& pattern() const { return *pattern_; }
    LinearSolver& solver() { return *solver_; }
    ClothModel& model() { return model_; }
    const ClothModel& model() const { return model_; }

    /// A += M.
    void add_mass(BlockMatrix& A) const;
    /// Turns the rows of held nodes into v = `value` and moves their columns to b.
    void hold(BlockMatrix& A, VectorXd& b, const std::vector<HeldNode>& held, const std::vector<Vector3d>& values);
    /// The same for v = 0 there.
    void hold(BlockMatrix& A, const std::vector<HeldNode>& held);

private:
    void update_fixed(const std::vector<HeldNode>& held);

    ClothModel& model_;
    std::unique_ptr<BlockPattern> pattern_;
    std::unique_ptr<BlockMatrix> A_;
    std::unique_ptr<LinearSolver> solver_;
    std::vector<int> held_nodes_;          // that fixed_ was made for
    FixedDofs fixed_;
    VectorXd known_, product_;
};

}  // namespace arcsim
