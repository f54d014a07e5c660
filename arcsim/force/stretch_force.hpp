#pragma once

#include <memory>
#include <vector>

#include "arcsim/force/cloth_force.hpp"
#include "arcsim/force/stretch_element.hpp"

namespace arcsim {

/// What the membrane needs to know of one face.
struct StretchFace {
    Triangle node;
    Matrix2d D_inverse;       // of D = [u1-u0, u2-u0], 1/m; zero for a face without area, which then has no force
    double area = 0;          // rest area, m²
    double damping = 0;       // beta, s
    double softening = 1;     // divides the stiffness: 1 + weakening * damage
    int material = 0;         // index into the tables
};

/// Of a face at positions x, 3n.
stretch::Strain<double> strain_of(const StretchFace& f, const VectorXd& x);

/// The membrane of ArcSim's cloth: the secant law S = K(G) G of stretch_element.hpp with measured tables.
///
/// No potential: k depends on G. @drops definite: see stretch::Coefficients; without negative eigenvalue as
/// long as k_uv² <= k_uu k_vv.
class StretchForce final : public ClothForce {
public:
    StretchForce(std::vector<StretchFace> faces, std::vector<std::shared_ptr<const StiffnessTable>> tables);

    std::string_view name() const override { return "stretch"; }
    std::optional<double> energy(const State&) const override { return std::nullopt; }
    double frozen_energy(const State& s) const override;
    void add_gradient(const State& s, VectorXd& g) const override;
    void add_hessian(const State& s, Tangent t, BlockMatrix& H) const override;
    void add_gradient_and_hessian(const State& s, Tangent t, VectorXd& g, BlockMatrix& H) const override;
    void add_step(const State& s, double h, VectorXd& f, BlockMatrix& A) const override;
    void add_damping(const State& s, BlockMatrix& H) const override;
    bool is_damped() const;
    const std::vector<StretchFace>& faces() const { return faces_; }
    bool is_unsymmetric() const override { return true; }
    void bind(const BlockPattern& pattern) override;

    /// Green strain (uu, vv, uv) of face f.
    Vector3d strain(const VectorXd& x, int f) const;
    /// Face with the largest principal stretch, and that stretch; the first face that is not finite, if any.
    std::pair<int, double> largest_stretch(const VectorXd& x) const;
    /// Largest entry of the tables at rest, N/m.
    double rest_stiffness() const;

private:
    struct Group;                       // eight faces, component by component
    struct GroupList;
    template <bool with_gradient, bool with_hessian, class Weight>
    void assemble(const VectorXd& x, double sign, Weight weight, VectorXd* g, BlockMatrix* H) const;
    void add_exact_hessian(const State& s, BlockMatrix& H) const;
    void make_groups(const std::vector<int>& order, const BlockPattern* pattern);

    std::vector<StretchFace> faces_;
    std::vector<std::shared_ptr<const StiffnessTable>> tables_;
    std::shared_ptr<GroupList> groups_;
};

}  // namespace arcsim
