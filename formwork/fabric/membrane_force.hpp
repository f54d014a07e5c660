#pragma once

#include <array>
#include <memory>
#include <vector>

#include "arcsim/force/force.hpp"
#include "arcsim/mesh/surface.hpp"
#include "formwork/fabric/flat_triangle.hpp"
#include "formwork/fabric/membrane_law.hpp"

namespace formwork {

using arcsim::BlockMatrix;
using arcsim::BlockPattern;
using arcsim::State;
using arcsim::Tangent;
using arcsim::Triangle;
using arcsim::Vector2d;
using arcsim::VectorXd;

/// In-plane forces of the fabric, constant strain per face, eight faces at a time.
///
///   F = [x_1 - x_0, x_2 - x_0] D^-1 (3x2),   eps = ½(FᵀF - I),   f_i = -A_t F S(eps) grad_i      (1), row 1: whole A_t
///   K_ij = A_t [ (grad_i . S grad_j) I + F (B_iᵀ C B_j) Fᵀ ]
///
/// @drops  definite: negative principal stresses from the geometric part, negative eigenvalues of C
class MembraneForce final : public arcsim::Force {
public:
    /// @param flat  per face, m
    /// @throws InputError naming the first face without rest area or with corners in clockwise order
    MembraneForce(const std::vector<Triangle>& faces, const std::vector<FlatTriangle>& flat,
                  std::shared_ptr<MembraneLaw> law);

    std::string_view name() const override { return "membrane"; }
    std::optional<double> energy(const State& s) const override;
    void add_gradient(const State& s, VectorXd& g) const override;
    void add_hessian(const State& s, Tangent t, BlockMatrix& H) const override;
    void add_gradient_and_hessian(const State& s, Tangent t, VectorXd& g, BlockMatrix& H) const override;
    void bind(const BlockPattern& p) override { pattern_ = &p; }
    bool is_unsymmetric() const override { return !law_->has_potential(); }

    /// Adds T0 A_t grad_i . grad_j I: the Laplacian of the rest shape, T0 in N/m. Regularises a membrane without
    /// tension: a motion that it resists least is a smooth one.
    void add_laplacian(double T0, BlockMatrix& H) const;

    MembraneLaw& law() { return *law_; }
    const MembraneLaw& law() const { return *law_; }
    int n_faces() const { return n_faces_; }
    double rest_area(int f) const { return groups_[f / arcsim::n_lanes].area[f % arcsim::n_lanes]; }
    double total_rest_area() const;
    /// Green strain (uu, vv, uv) of face f.
    Vector3d strain(const VectorXd& x, int f) const;
    /// Deformation gradient of face f, 3x2.
    arcsim::Matrix32d deformation(const VectorXd& x, int f) const;
    /// Largest and smallest principal stretch over all faces.
    std::array<double, 2> stretch_range(const VectorXd& x) const;

private:
    struct alignas(64) Group {              // eight faces; the last group is filled up with area 0
        Lanes gu1, gv1, gu2, gv2;           // gradients of corners 1 and 2 in (u, v), 1/m
        Lanes area;                         // rest, m²
        int node[3][arcsim::n_lanes];
    };
    struct Frame;                           // F and the strain of a group
    template <bool gradient, bool hessian>
    void assemble(const State& s, Tangent t, VectorXd* g, BlockMatrix* H) const;
    void frame(const Group& group, const VectorXd& x, Frame& out) const;

    std::vector<Group> groups_;
    int n_faces_ = 0;
    std::shared_ptr<MembraneLaw> law_;
    const BlockPattern* pattern_ = nullptr;
};

}  // namespace formwork
