#pragma once

#include "formwork/fabric/membrane_law.hpp"

namespace formwork {

/// The project's own isotropic fabric: the table is read in the frame of the principal strains e1 >= e2, so that no
/// face's arbitrary frame enters (SYSTEM row 5). With k, q the interpolated k_uu and k_uv at lambda_max,
///
///   secant      S_i = k(e1) e_i + q(e1) e_j                                   (1)
///   separable   psi(e1) + psi(e2) + q e1 e2, psi'(e) = k(e) e, constant q     (SYSTEM row 2)
///
/// k is linear in lambda = sqrt(1 + 2e) from 1 to max_stretch and constant outside. Relaxed (tension field): slack
/// for e1 <= 0, wrinkled where S_2 < 0: then S_2 = 0 and e2 is replaced by -q e1 / k (tension_field.md 1).
class IsotropicMembrane final : public MembraneLaw {
public:
    explicit IsotropicMembrane(const MaterialParams& p);
    void evaluate(const StrainLanes& e, Want want, StressLanes& out) const override;
    FaceState state(const Vector3d& eps) const override;
    Vector3d fabric_strain(const Vector3d& eps) const override;
    bool has_potential() const override { return separable_; }
    double rest_stiffness() const override { return k0_; }
    double largest_stiffness() const override { return k0_ > k1_ ? k0_ : k1_; }

private:
    struct Stiffness {
        Lanes k, dk, q, dq;   // and derivatives by the strain e
    };
    Stiffness stiffness(const Lanes& e) const;
    Lanes potential(const Lanes& e) const;

    double k0_, k1_, q0_, q1_, range_;   // N/m; range_ = max_stretch - 1
    bool separable_;                     // also a secant law of constant stiffness
};

}  // namespace formwork
