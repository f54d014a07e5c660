#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "arcsim/base/types.hpp"
#include "arcsim/material/material_data.hpp"

namespace formwork {

using arcsim::Matrix3d;
using arcsim::Vector3d;

/// Tension of flat cloth; strains and tensions are (uu, vv, uv) in the weave frame, uv the tensor component.
struct StripStress {
    Vector3d S;    // second Piola-Kirchhoff, N/m
    Matrix3d D;    // dS/dG, N/m; not symmetric: the secant law has no potential
};

/// dS/dp_j of the parameters that act at one strain; most of a table's entries do not.
struct StressSensitivity {
    std::vector<int> parameter;
    std::vector<Vector3d> dS;      // N/m per unit of the parameter
};

/// A law with parameters that `fit` can estimate. S is linear in the parameters as long as no interpolated
/// stiffness is cut at zero.
class StripLaw {
public:
    virtual ~StripLaw() = default;
    virtual StripStress stress(const Vector3d& G) const = 0;
    virtual StressSensitivity sensitivity(const Vector3d& G) const = 0;
    virtual int n_parameters() const = 0;
    virtual std::string parameter_name(int j) const = 0;
    virtual std::vector<double> parameters() const = 0;
    virtual std::unique_ptr<StripLaw> with(const std::vector<double>& p) const = 0;
    /// Moves entries to the nearest stable fabric: k_uv below sqrt(k_uu k_vv) in every row.
    virtual void make_stable(std::vector<double>& p) const = 0;
};

/// The tensor law S = K(G) G with ArcSim's table evaluated exactly (SYSTEM rows 2, 3 and 12), compression
/// included: the strip of a tensile test is held flat.
/// Parameters: the 24 entries of the rows, row by row, N/m as in the material file (before the factor 2).
class TableStripLaw final : public StripLaw {
public:
    /// @param factor  of every entry: StiffnessTable::file_factor times stretching_mult
    TableStripLaw(const arcsim::StretchingRows& rows, double factor, double max_stretch = 7.0 / 6);
    StripStress stress(const Vector3d& G) const override;
    StressSensitivity sensitivity(const Vector3d& G) const override;
    int n_parameters() const override { return 24; }
    std::string parameter_name(int j) const override;
    std::vector<double> parameters() const override;
    std::unique_ptr<StripLaw> with(const std::vector<double>& p) const override;
    void make_stable(std::vector<double>& p) const override;

private:
    arcsim::StretchingRows rows_;
    double factor_, full_strain_;
};

/// The isotropic law in the principal frame, S_i = k_uu(lambda_max) e_i + k_uv(lambda_max) e_j (SYSTEM rows 2
/// and 5). Parameters: k_uu and k_uv at rest and at max_stretch, N/m.
class IsotropicStripLaw final : public StripLaw {
public:
    IsotropicStripLaw(const std::array<double, 4>& kuu_kuv_rest_max, double factor, double max_stretch = 7.0 / 6);
    StripStress stress(const Vector3d& G) const override;
    StressSensitivity sensitivity(const Vector3d& G) const override;
    int n_parameters() const override { return 4; }
    std::string parameter_name(int j) const override;
    std::vector<double> parameters() const override { return {p_.begin(), p_.end()}; }
    std::unique_ptr<StripLaw> with(const std::vector<double>& p) const override;
    void make_stable(std::vector<double>& p) const override;

private:
    std::array<double, 4> p_;   // uu rest, uv rest, uu max, uv max
    double factor_, full_strain_;
};

}  // namespace formwork
