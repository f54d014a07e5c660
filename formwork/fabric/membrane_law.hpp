#pragma once

#include <memory>

#include "arcsim/base/lanes.hpp"
#include "arcsim/base/types.hpp"
#include "formwork/fabric/material_params.hpp"
#include "formwork/strain/strain_field.hpp"

namespace formwork {

using arcsim::Lanes;
using arcsim::Matrix3d;
using arcsim::Vector3d;

/// Green strain of eight faces in their weave frames; uv is the tensor shear.
struct StrainLanes {
    Lanes uu, vv, uv;
};

/// Second Piola-Kirchhoff stress of eight faces and its derivative.
///
/// The derivative is taken by v = (e_uu, e_vv, 2 e_uv), so that a law with a potential has a symmetric C;
/// C = C_sym + C_skew with C_sym = {00, 01, 02, 11, 12, 22} and C_skew = {01, 02, 12}.
struct StressLanes {
    Lanes uu, vv, uv;   // N/m
    Lanes C[6];         // N/m
    Lanes skew[3];      // N/m
    Lanes psi;          // J/m², when the law has a potential
};

enum class Want { stress, tangent, definite_tangent, energy };

/// What makes a tension field unique and well posed (tension_field.md 1, 3): W = (1-r) W_relaxed + r W_full
/// + Tp tr(eps).
struct Regulariser {
    double r = 0;    // residual stiffness
    double Tp = 0;   // prestress, N/m
};

/// Stress of a membrane in its rest plane: S(eps). Evaluated for eight faces at once.
class MembraneLaw {
public:
    virtual ~MembraneLaw() = default;
    /// `energy` fills psi and the stress; the tangents fill the stress too. definite_tangent: symmetric, no
    /// negative eigenvalue.
    virtual void evaluate(const StrainLanes& e, Want want, StressLanes& out) const = 0;
    /// Judged by the relaxed law alone: slack by strain, taut by stress. Compression `full`: by the signs of the
    /// principal stresses.
    virtual FaceState state(const Vector3d& eps) const = 0;
    /// The strain of the fabric itself: eps + p n n^T where a face is wrinkled (across the tension the cloth folds, and
    /// that shortening is geometry), nothing where it is slack, eps where it is taut or compression is `full`.
    virtual Vector3d fabric_strain(const Vector3d& eps) const = 0;
    virtual bool has_potential() const = 0;
    /// True when dS/deps is so far from symmetric that its symmetric half makes a poor Newton matrix.
    virtual bool is_strongly_unsymmetric() const { return false; }
    /// Larger of the rest stiffnesses, N/m: what residuals are scaled with.
    virtual double rest_stiffness() const = 0;
    /// Largest stiffness that any strain of the table shows, N/m.
    virtual double largest_stiffness() const = 0;

    bool is_tension_field() const { return tension_field_; }
    const Regulariser& regulariser() const { return regulariser_; }
    void set_regulariser(const Regulariser& r) { regulariser_ = r; }

protected:
    explicit MembraneLaw(bool tension_field) : tension_field_(tension_field) {}
    bool tension_field_;
    Regulariser regulariser_;
};

/// @throws InputError: the material file cannot be read
std::unique_ptr<MembraneLaw> make_membrane_law(const MaterialParams& p);

/// One face alone: for tests, reports and strain fields.
struct FaceStress {
    Vector3d S;      // uu, vv, uv, N/m
    Matrix3d C;      // by (e_uu, e_vv, 2 e_uv), N/m; the exact one, unsymmetric where the law is
    double psi = 0;  // J/m²
};
FaceStress evaluate_one(const MembraneLaw& law, const Vector3d& eps, Want want = Want::tangent);

}  // namespace formwork
