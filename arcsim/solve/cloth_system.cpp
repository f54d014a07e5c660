#include "arcsim/solve/cloth_system.hpp"

namespace arcsim {

ClothSystem::ClothSystem(ClothModel& model, FillOrder order, SolverKind solver) : model_(model) {
    std::vector<std::array<int, 2>> pairs;
    model.bend->list_pairs(pairs);
    model.springs.list_pairs(pairs);
    pattern_ = std::make_unique<BlockPattern>(model.n_nodes(), model.faces, pairs,
                                              fill_order(model.n_nodes(), model.faces, pairs, order));
    A_ = std::make_unique<BlockMatrix>(*pattern_);
    model.stretch->bind(*pattern_);
    model.bend->bind(*pattern_);
    model.wind->bind(*pattern_);
    model.springs.bind(*pattern_);
    solver_ = make_linear_solver(solver);
    solver_->analyze(*pattern_);
}

void ClothSystem::add_mass(BlockMatrix& A) const {
    for (int i = 0; i < model_.n_nodes(); ++i) A.add_to_diagonal(i, model_.mass[i]);
}

void ClothSystem::update_fixed(const std::vector<HeldNode>& held) {
    std::vector<int> nodes;
    for (const HeldNode& h : held) nodes.push_back(h.node);
    if (nodes == held_nodes_) return;
    std::vector<char> flags(3 * model_.n_nodes(), 0);
    for (int node : nodes)
        for (int c = 0; c < 3; ++c) flags[3 * node + c] = 1;
    fixed_ = FixedDofs(*pattern_, std::move(flags));
    held_nodes_ = std::move(nodes);
}

void ClothSystem::hold(BlockMatrix& A, VectorXd& b, const std::vector<HeldNode>& held,
                       const std::vector<Vector3d>& values) {
    if (held.empty()) return;
    update_fixed(held);
    known_.setZero(b.size());
    for (size_t i = 0; i < held.size(); ++i) known_.segment<3>(3 * held[i].node) = values[i];
    A.multiply_symmetric(known_, product_);
    b -= product_;
    for (size_t i = 0; i < held.size(); ++i) b.segment<3>(3 * held[i].node) = values[i];
    A.fix(fixed_);
}

void ClothSystem::hold(BlockMatrix& A, const std::vector<HeldNode>& held) {
    if (held.empty()) return;
    update_fixed(held);
    A.fix(fixed_);
}

}  // namespace arcsim
