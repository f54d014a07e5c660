#pragma once

#include <vector>

#include "arcsim/force/force.hpp"
#include "formwork/load/plaster_params.hpp"

namespace formwork {

using arcsim::BlockMatrix;
using arcsim::BlockPattern;
using arcsim::State;
using arcsim::Tangent;
using arcsim::Triangle;
using arcsim::Vector3d;
using arcsim::VectorXd;

/// The liquid at one shape and level.
struct LiquidTotals {
    double volume = 0;       // m³, below the level: the liquid's weight is rho g volume
    double waterplane = 0;   // m²: area of the free surface, dvolume/dlevel
};

/// Load of the liquid plaster on the fabric: p = rho g q⁺ + overpressure, q = h - z the depth below the level h, z = x.d
/// the height along `up` (SYSTEM section 2; d points up, so that q > 0 means wet).
///
///   consistent   f_a = int p phi_a n dA = N sum_b W_ab rho g q_b + N p0 / 3, N the face's area vector, W exact on the
///                wet part [IDENTITIES 2]
///   lumped       f_a = (A_a n_a) p_a, with A_a n_a read as the ring's area vector sum N / 3 (on a rough surface area
///                times unit normal does not sum to the liquid's weight)                                      (8)
///
/// The normals are those of the faces times `orientation`, the sign for which the weight acts downward.
/// df/dx has three versions (SYSTEM row 8): consistent, the exact one:
///   df_a/dx_b = -rho g W_ab N d^T + P_a/2 [x_{b+2} - x_{b+1}]_x;  lumped (9): -rho g A_a n_a d^T;  none.
/// Assembled, the exact one is symmetric where boundary nodes are held or dry; its antisymmetric half goes to general
/// matrices and is dropped from symmetric ones.
///
/// @drops  definite: everything (the pressure's tangent has no definite part of use)
class PressureForce final : public arcsim::Force {
public:
    PressureForce(std::vector<Triangle> faces, const Vector3d& up, double rho_g, double overpressure,
                  PressureQuadrature quadrature, PressureJacobian jacobian);

    std::string_view name() const override { return "plaster"; }
    /// ½ rho g int q² n.d dA - p0 int (z - z_ref) n.d dA: a potential of the consistent load when every boundary edge is
    /// held, or dry and without overpressure, or in the plane z = z_ref (`set_reference`). nullopt when lumped.
    std::optional<double> energy(const State& s) const override;
    void add_gradient(const State& s, VectorXd& g) const override;
    void add_hessian(const State& s, Tangent t, BlockMatrix& H) const override;
    void add_gradient_and_hessian(const State& s, Tangent t, VectorXd& g, BlockMatrix& H) const override;
    void bind(const BlockPattern& p) override { pattern_ = &p; }
    bool is_unsymmetric() const override { return true; }

    double level() const { return level_; }
    void set_level(double h) { level_ = h; }                    // m, along up
    void set_orientation(int sign) { orientation_ = sign; }     // +1: normals point out of the liquid
    int orientation() const { return orientation_; }
    void set_reference(double z) { z_ref_ = z; }
    void set_scale(double s) { scale_ = s; }                    // of density and overpressure: load steps
    double rho_g() const { return scale_ * rho_g_; }
    double overpressure() const { return scale_ * overpressure_; }
    bool presses() const { return rho_g() != 0 || overpressure() != 0; }   // a bag without load pays for none
    const Vector3d& up() const { return up_; }
    PressureQuadrature quadrature() const { return quadrature_; }

    LiquidTotals totals(const VectorXd& x, double level) const;
    /// b = df/dlevel, 3n, N/m.
    void level_derivative(const VectorXd& x, VectorXd& b) const;

private:
    struct Lanes3;
    template <bool gradient, bool hessian>
    void assemble(const State& s, VectorXd* g, BlockMatrix* H) const;
    arcsim::Matrix3d weights(const Vector3d& q) const;
    Vector3d heights(const VectorXd& x, const Triangle& t) const;
    Vector3d area_vector(const VectorXd& x, const Triangle& t) const;

    std::vector<Triangle> faces_;
    Vector3d up_;
    double rho_g_, overpressure_, scale_ = 1, level_ = 0, z_ref_ = 0;
    PressureQuadrature quadrature_;
    PressureJacobian jacobian_;
    int orientation_ = 1;
    const BlockPattern* pattern_ = nullptr;
};

/// The sign that makes the liquid's weight act downward on these faces: that of the liquid's volume; for a shape that
/// holds none yet, that of the faces' downward area; for a closed shape outside the liquid, outward. +1 when nothing
/// decides (then the mesh's normals are kept).
int liquid_orientation(const std::vector<Triangle>& faces, const VectorXd& x, const Vector3d& up, double level);

/// The level at which the shape holds `volume`, above the highest node where an open rim lets it; infinite for a closed
/// shape that is too small.
double level_of_volume(const PressureForce& load, const VectorXd& x, double volume, double start);

}  // namespace formwork
