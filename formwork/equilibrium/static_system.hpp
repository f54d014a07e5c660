#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "formwork/equilibrium/equilibrium.hpp"
#include "formwork/fabric/membrane_force.hpp"
#include "formwork/fabric/seam_force.hpp"
#include "formwork/load/pressure_force.hpp"

namespace formwork {

/// Sizes from which the solver's scales are taken; they depend on the rest shape and the load, never on the start.
struct Scales {
    double radius = 0;        // R: of the filled shape's curvature, about, m
    double reach = 0;         // largest half width of the rest shape, m
    double area = 0;          // of the rest shape, m²
    double pressure = 0;      // largest expected, Pa
    double tension = 0;       // T* = pressure R, N/m; without a load, a thousandth of the stiffness
};

/// Forces of fabric, seams, liquid and self-weight on one mesh, with the level of a prescribed volume eliminated:
/// at every shape it is the one at which the bag holds that volume, so that level and shape are one problem.
class StaticSystem {
public:
    explicit StaticSystem(const EquilibriumProblem& p);

    const arcsim::BlockPattern& pattern() const { return *pattern_; }
    const arcsim::FixedDofs& fixed() const { return fixed_; }
    const Scales& scales() const { return scales_; }
    MembraneForce& membrane() { return *membrane_; }
    const MembraneForce& membrane() const { return *membrane_; }
    PressureForce& pressure() { return *pressure_; }
    const PressureForce& pressure() const { return *pressure_; }
    const SeamForce& seams() const { return seams_; }
    bool has_liquid() const { return has_liquid_; }
    bool has_load() const { return has_load_; }
    bool level_is_unknown() const { return target_volume_ > 0; }
    /// While the bag is still flat, the level that its volume asks for may stand metres above it: until the bag has opened
    /// the level stops at a cap, and is then a prescribed one. An equilibrium at the cap is none: raise it and go on.
    bool level_is_capped() const { return level_is_capped_; }
    void raise_level_cap() { level_cap_ += scales_.radius; }
    double target_volume() const { return target_volume_; }
    bool is_closed() const { return is_closed_; }            // no face has an open edge
    double rim_height() const { return rim_height_; }        // mean height of the held nodes; NaN without any
    double ordering_s() const { return ordering_s_; }

    /// Scales density, overpressure and self-weight: load steps.
    void set_load_factor(double s);
    double load_factor() const { return load_factor_; }
    /// Finds the level that belongs to x; nothing to do when it is prescribed.
    void update_level(const VectorXd& x);

    struct Balance {
        double residual = 0;   // |g| over free dofs, N
        double load = 0;       // |applied load| over free dofs, N; the held nodes' reaction where there is no load
    };
    /// g = -(sum of all forces), 3n, with held entries: the reactions.
    Balance gradient(const VectorXd& x, VectorXd& g);
    /// The residual against the load; until the liquid has found its place that may be next to nothing, and a millionth of
    /// the expected one stands in.
    double relative(const Balance& b) const;
    /// Tangent with T0 times the rest shape's Laplacian, held rows fixed. `border` (3n) gets b / sqrt(rho g waterplane):
    /// the unknown level adds border border^T; empty when the level is prescribed.
    void tangent(const VectorXd& x, double T0, BlockMatrix& H, VectorXd& border, arcsim::Tangent kind);
    /// w_fabric H_fabric + w_other H_other (seams, liquid), nothing fixed: for steps in time, whose damping acts on the
    /// fabric alone. `kind` is the fabric's and the seams'; the liquid's is always the chosen Jacobian.
    void weighted_tangent(const VectorXd& x, double w_fabric, double w_other, arcsim::Tangent kind, BlockMatrix& H,
                          VectorXd& border);
    /// Raises T0 of a tangent already made.
    void add_laplacian(double T0, BlockMatrix& H) const;
    /// Adds the liquid's exact tangent at the x of the last tangent, which `definite` leaves out.
    void add_pressure_tangent(BlockMatrix& H) const;

private:
    void set_fill(const EquilibriumProblem& p, const VectorXd& rest);
    void level_border(const VectorXd& x, VectorXd& border) const;

    std::unique_ptr<arcsim::BlockPattern> pattern_;
    arcsim::FixedDofs fixed_;
    std::unique_ptr<MembraneForce> membrane_;
    std::unique_ptr<PressureForce> pressure_;
    SeamForce seams_;
    VectorXd weight_;          // self-weight, 3n, N
    Scales scales_;
    bool has_liquid_ = false, has_load_ = false, has_weight_ = false, is_closed_ = false, level_is_capped_ = false;
    double target_volume_ = 0, rim_height_ = 0, load_factor_ = 1, ordering_s_ = 0;
    double level_cap_ = 1e300;
    State state_;
};

VectorXd flatten(const std::vector<Vector3d>& x);
std::vector<Vector3d> unflatten(const VectorXd& x);

}  // namespace formwork
