#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "arcsim/base/block_matrix.hpp"
#include "arcsim/base/types.hpp"

namespace arcsim {

/// Where the cloth is and how fast it moves; 3n each, node by node.
struct State {
    VectorXd x;      // m
    VectorXd v;      // m/s; may be empty in statics
    double time = 0; // s
};

/// exact: the derivative of the force as it is. definite: symmetric, without negative eigenvalue; a force
/// says in its docstring which terms it drops for that.
enum class Tangent { exact, definite };

/// One physical effect on the cloth: E(x), g = dE/dx, H = d²E/dx². The force is f = -g.
///
/// A force adds into vectors and matrices that others add to as well. Its blocks' places are looked up once
/// (`bind`), so that assembly is a plain loop. Matrix entries of held nodes are added like all others: the
/// caller fixes them afterwards.
class Force {
public:
    virtual ~Force() = default;
    virtual std::string_view name() const = 0;

    /// J; nullopt: f has no potential.
    virtual std::optional<double> energy(const State& s) const = 0;
    /// g (3n) += -f, N.
    virtual void add_gradient(const State& s, VectorXd& g) const = 0;
    /// H += -df/dx, N/m.
    virtual void add_hessian(const State& s, Tangent t, BlockMatrix& H) const = 0;
    /// Both at once; worth overriding where they share work.
    virtual void add_gradient_and_hessian(const State& s, Tangent t, VectorXd& g, BlockMatrix& H) const {
        add_gradient(s, g);
        add_hessian(s, t, H);
    }
    /// H += -df/dv, N s/m: velocity-dependent forces only.
    virtual void add_velocity_hessian(const State&, BlockMatrix&) const {}

    /// Node pairs that the force couples beyond those of the mesh's faces.
    virtual void list_pairs(std::vector<std::array<int, 2>>&) const {}
    /// Called once per pattern, before any add_hessian with a matrix of that pattern.
    virtual void bind(const BlockPattern&) {}
    /// True when the exact tangent has an antisymmetric part that is not round-off.
    virtual bool is_unsymmetric() const { return false; }
};

}  // namespace arcsim
