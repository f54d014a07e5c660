#pragma once

#include <memory>
#include <vector>

#include "arcsim/force/cloth_force.hpp"
#include "arcsim/material/bending_table.hpp"

namespace arcsim {

/// What bending needs to know of one interior edge.
struct Hinge {
    std::array<int, 4> node;           // see hinge_element.hpp
    double length = 0;                 // l: mean of the two sides' material lengths, m
    double area = 0;                   // a = A0 + A1, rest, m²
    double rest_angle = 0;             // rad
    double damping = 0;                // beta, s
    double softening = 1;              // divides the stiffness
    std::array<double, 2> direction{}; // per side, BendingTable::direction of its material edge
    std::array<int, 2> material{};     // per side, index into the tables
};

/// ArcSim's discrete bending.
///
///   E = k l² / (8 a) (theta - theta_rest)²,   f = -k l² / (4 a) (theta - theta_rest) grad theta
///
/// k is the smaller of the two sides' table values at the lagged angle: theta of the positions one step
/// earlier. With k held it is a potential. When k follows theta instead (`follow_angle`, refreshed at the
/// present positions), the exact tangent includes dk/dtheta. @drops definite: the second derivative of theta (Gauss-Newton).
class BendForce final : public ClothForce {
public:
    BendForce(std::vector<Hinge> hinges, std::vector<BendingTable> tables, const VectorXd& x);

    std::string_view name() const override { return "bend"; }
    std::optional<double> energy(const State& s) const override { return frozen_energy(s); }
    double frozen_energy(const State& s) const override;
    void add_gradient(const State& s, VectorXd& g) const override;
    void add_hessian(const State& s, Tangent t, BlockMatrix& H) const override;
    void add_gradient_and_hessian(const State& s, Tangent t, VectorXd& g, BlockMatrix& H) const override;
    void add_step(const State& s, double h, VectorXd& f, BlockMatrix& A) const override;
    void add_damping(const State& s, BlockMatrix& H) const override;
    void refresh(const VectorXd& x) override;
    /// What `refresh` at the positions of the last `add_step` would do, with the angles that it has found there.
    void keep_step_angles();
    void list_pairs(std::vector<std::array<int, 2>>& pairs) const override;
    void bind(const BlockPattern& pattern) override;

    bool is_damped() const;
    /// For methods that refresh at the present positions, so that nothing lags.
    void follow_angle() { follows_ = true; }
    /// The lagged angles, rad, by hinge: what a resumed run needs beside positions.
    const std::vector<double>& lagged_angles() const { return lagged_; }
    void set_lagged_angles(std::vector<double> angles);
    /// Takes the present angles as the rest angles.
    void set_rest_angles_from(const VectorXd& x);
    const std::vector<Hinge>& hinges() const { return hinges_; }

private:
    struct Group;
    struct GroupList;
    template <bool with_gradient, bool with_hessian, class Weight>
    void assemble(const VectorXd& x, double sign, Weight weight, VectorXd* g, BlockMatrix* H) const;
    void add_exact_hessian(const VectorXd& x, BlockMatrix& H) const;
    void make_groups(const std::vector<int>& order, const BlockPattern* pattern);
    void look_up_stiffness();
    double angle(const VectorXd& x, int hinge) const;

    std::vector<Hinge> hinges_;
    std::vector<BendingTable> tables_;
    std::vector<double> lagged_;          // rad
    mutable std::vector<double> present_; // rad, at the positions of the last gradient
    std::vector<double> stiffness_;       // k l² / (4 a), N m
    std::vector<double> slope_;           // its derivative by theta, N m
    bool follows_ = false;
    std::shared_ptr<GroupList> groups_;
};

}  // namespace arcsim
