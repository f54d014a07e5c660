#pragma once

#include <limits>
#include <vector>

#include "arcsim/force/force.hpp"
#include "arcsim/force/stretch_force.hpp"

namespace arcsim {

/// A face whose principal stretches are bounded.
struct LimitedFace {
    int number = 0;           // of the face in its cloth
    StretchFace face;
    double smallest = 0;      // principal stretch; 0: no bound
    double largest = std::numeric_limits<double>::infinity();
};

/// Bounds of the principal stretches, as an augmented Lagrangian. With the Green strain G of a face, the
/// bounds are matrix inequalities, g_min I ≼ G ≼ g_max I, g = (stretch² - 1)/2, and their multipliers are
/// membrane stresses without negative eigenvalues, N/m: what the limit carries beside the cloth,
///
///   S⁺ = (Λ⁺ + μ (G - g_max I))₊,   S⁻ = (Λ⁻ + μ (g_min I - G))₊,   S = S⁺ - S⁻
///   E = sum A (|S⁺|² - |Λ⁺|² + |S⁻|² - |Λ⁻|²) / (2 μ)
///
/// At Λ = S the limit holds and the stress does no work while a face moves freely. Bounding the matrix and not
/// two sorted numbers keeps the force smooth where the principal stretches meet. An upper bound is convex in x.
///
/// ArcSim limits the singular values of P by an augmented Lagrangian too; its penalty, its updates and when it
/// stops are not known, so that limited scenes agree with it in kind, not in digits.
///
/// @drops definite: the geometric stiffness of S⁻
class StrainLimitForce final : public Force {
public:
    explicit StrainLimitForce(std::vector<LimitedFace> faces);

    std::string_view name() const override { return "strain limits"; }
    std::optional<double> energy(const State& s) const override;
    void add_gradient(const State& s, VectorXd& g) const override;
    void add_hessian(const State& s, Tangent t, BlockMatrix& H) const override;

    void set_penalty(double mu) { mu_ = mu; }   // N/m
    double penalty() const { return mu_; }
    /// Λ = S. Returns how far bounds and multipliers were from fitting each other: the largest |S - Λ|/μ, a strain.
    double update(const VectorXd& x);
    /// No face is beyond its bounds, and no limit carries anything.
    bool is_idle(const VectorXd& x) const;

    struct Excess {
        int face = -1;                      // number in the cloth
        double stretch = 1, beyond = 0;     // beyond: by how much the bound is missed
    };
    Excess worst(const VectorXd& x) const;

    std::vector<double> multipliers() const;
    void set_multipliers(const std::vector<double>& values);   // of another size, or empty: zero
    std::size_t n_multipliers() const { return 6 * faces_.size(); }

private:
    struct Item {
        LimitedFace limit;
        double g_min, g_max;
        Vector3d lambda_max = Vector3d::Zero(), lambda_min = Vector3d::Zero();
    };
    Vector3d trial_max(const Item& f, const Vector3d& G) const;   // before its positive part is taken
    Vector3d trial_min(const Item& f, const Vector3d& G) const;

    std::vector<Item> faces_;
    double mu_ = 1;
};

}  // namespace arcsim
