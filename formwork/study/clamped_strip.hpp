#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "formwork/study/sparse_lu.hpp"
#include "formwork/study/strip_law.hpp"
#include "formwork/study/strip_mesh.hpp"

namespace formwork {

/// An equilibrium of the strip.
struct StripState {
    std::vector<Vector2d> x;     // m
    double displacement = 0;     // of the moving clamp along the strip, m
    double force = 0;            // on the moving clamp along the strip, N
    double stiffness = 0;        // d force / d displacement, N/m, from the tangent at equilibrium
    int iterations = 0;          // Newton steps in all, those of bisected increments included
    double residual = 0;         // largest unbalanced nodal force over the largest nodal force
};

/// The strip of the tensile test (§9): a plane membrane between two hard clamps that hold it across its whole
/// width, so that it cannot contract there; free long edges. Static equilibria by Newton's method with the exact
/// tangent, which the secant law makes unsymmetric, hence LU.
///
/// The strip is held flat: a thin fabric may buckle out of the plane beside the clamps, which is left out here.
class ClampedStrip {
public:
    /// @param angle  from the warp to the strip's axis, rad
    ClampedStrip(StripMesh mesh, double angle);

    StripState at_rest() const;

    /// Follows prescribed displacements: the state at `displacement`, reached from `from`.
    /// @throws NumericalError when no increment is small enough
    StripState pull_to(const StripLaw& law, const StripState& from, double displacement);
    /// The same for a prescribed force; the displacement is an unknown of the same Newton iteration.
    StripState load_to(const StripLaw& law, const StripState& from, double force);

    /// dF/dp of the clamp force at fixed displacement, by the adjoint of the tangent at the equilibrium `s`:
    ///   dF/dp = ∫ (B w)^T dS/dp dA,   w = e_clamp - K^-T (dF/dx)^T
    arcsim::VectorXd force_sensitivity(const StripLaw& law, const StripState& s);

    /// Half the width that is left in the strip's middle, m.
    double mid_half_width(const StripState& s) const;
    /// Mean over the area of the Green strain in the weave frame; says what a test has exercised.
    Vector3d mean_strain(const StripState& s) const;
    const StripMesh& mesh() const { return mesh_; }

private:
    using VectorXd = arcsim::VectorXd;
    static constexpr int n_nodes = 6, n_dofs = 12, n_points = 6;
    using Gradient = Eigen::Matrix<double, n_nodes, 2>;   // of the shape functions by (u, v), 1/m
    struct Point {                                        // of the quadrature
        double area;                                      // m²
        Gradient gradient;
    };
    struct Element {
        std::array<int, n_nodes> node;
        std::array<Point, n_points> point;
        std::array<int, n_dofs> dof;              // free index; fixed_dof or clamp_dof otherwise
        std::array<int, n_dofs * n_dofs> place;   // in the matrix's values, column by column; -1: not there
    };
    struct System {
        VectorXd residual;     // internal force at the free degrees of freedom, N
        VectorXd column, row;  // d residual / d clamp, d force / d free
        double force = 0, stiffness = 0, scale = 0;
    };
    static constexpr int fixed_dof = -1, clamp_dof = -2;

    StripState increment(const StripLaw& law, StripState s, bool force_control, double target);
    bool newton(const StripLaw& law, StripState& s, bool force_control, double target);
    static Vector3d strain(const Element& e, const Point& p, const StripState& s, Eigen::Matrix2d& F);
    System assemble(const StripLaw& law, const StripState& s, bool with_matrix);
    void move(StripState& s, const VectorXd& du, double d_clamp, double part) const;

    StripMesh mesh_;
    std::vector<Element> elements_;
    std::vector<std::array<int, 2>> node_dof_;
    int n_free_ = 0;
    Eigen::SparseMatrix<double> K_;
    SparseLu lu_;
};

}  // namespace formwork
