#pragma once

#include "arcsim/material/stiffness_table.hpp"
#include "formwork/fabric/membrane_law.hpp"

namespace formwork {

/// ArcSim's orthotropic fabric in the weave frame: S_uu = k_uu e_uu + k_uv e_vv, S_vv = k_vv e_vv + k_uv e_uu,
/// S_uv = k_ss e_uv (SYSTEM row 3) with k = k(eps) from the material's table.
///
/// Relaxed (tension field): a wrinkled face takes up a wrinkle strain p n n^T, p >= 0, normal to the direction t of its
/// one tension, such that K (eps + p n n^T) = sigma t t^T, with the secant stiffness K of the strain eps itself. (K of
/// eps + p n n^T would be another reading; its equations lose their solution where t crosses a kink of the table, and the
/// stress jumps there: sewn bags then cycle at a residual of 1e-3.) Only a table of constant stiffness has a potential.
class TensorMembrane final : public MembraneLaw {
public:
    TensorMembrane(const arcsim::StretchingRows& rows, arcsim::Sampling sampling, double multiplier,
                   Compression compression);
    void evaluate(const StrainLanes& e, Want want, StressLanes& out) const override;
    FaceState state(const Vector3d& eps) const override;
    Vector3d fabric_strain(const Vector3d& eps) const override;
    bool has_potential() const override { return constant_; }
    /// The table turns with the principal stretch: at 1 % strain the woven fabric's coupling of shear into warp
    /// tension is half its warp stiffness, and the symmetric half of the tangent is not even definite.
    bool is_strongly_unsymmetric() const override { return !constant_; }
    double rest_stiffness() const override { return rest_stiffness_; }
    double largest_stiffness() const override { return largest_stiffness_; }

private:
    arcsim::Stiffness4 stiffness(const Vector3d& eps) const { return constant_ ? constant_sample_.k : table_.k(eps); }
    void evaluate_face(const Vector3d& eps, Want want, FaceStress& out) const;

    arcsim::StiffnessTable table_;
    arcsim::StiffnessSample constant_sample_;
    bool constant_;
    double rest_stiffness_, largest_stiffness_;
};

}  // namespace formwork
