#pragma once

#include "arcsim/force/force.hpp"

namespace arcsim {

/// Air on the faces. With the mean velocity v_f of a face, w = v_air - v_f, its part w_n = n . w along the
/// normal and w_t across it:
///
///   F = density A |w_n| w_n n + drag A w_t,   a third to each corner; A the rest area
///
/// `drag` is not multiplied by the density. The normal n is lagged, that of the positions one step earlier, unless
/// it is told to follow them. ArcSim's step treats the force as constant; the converged methods use its derivatives
/// by velocity and, through the normal, by position.
///
/// No potential. @drops definite: the derivative by position
class WindForce final : public Force {
public:
    struct Face {
        Triangle node;
        double area;   // rest, m²
    };
    WindForce(std::vector<Face> faces, double density, double drag, const Vector3d& velocity, const VectorXd& x);

    std::string_view name() const override { return "wind"; }
    std::optional<double> energy(const State&) const override { return std::nullopt; }
    void add_gradient(const State& s, VectorXd& g) const override;
    void add_hessian(const State& s, Tangent t, BlockMatrix& H) const override;
    void add_velocity_hessian(const State& s, BlockMatrix& H) const override;
    void bind(const BlockPattern& pattern) override { pattern_ = &pattern; }
    bool is_unsymmetric() const override { return follows_; }
    void refresh(const VectorXd& x);
    /// From now on the normals are those of the state at hand, and nothing lags.
    void follow_normal() { follows_ = true; }
    bool acts() const { return density_ > 0 || drag_ > 0; }

private:
    Vector3d relative_velocity(const State& s, const Face& f) const;
    Vector3d normal(const VectorXd& x, size_t face) const;

    std::vector<Face> faces_;
    std::vector<Vector3d> normals_;
    double density_, drag_;
    Vector3d velocity_;
    bool follows_ = false;
    const BlockPattern* pattern_ = nullptr;
};

}  // namespace arcsim
