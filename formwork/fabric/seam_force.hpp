#pragma once

#include <vector>

#include "arcsim/force/force.hpp"
#include "formwork/fabric/seam_spring.hpp"

namespace formwork {

/// The seams' threads: springs along seam edges, both ends on the seam (SYSTEM row 11).
///
///   E = ½ kappa (l - L)²,   f_i = kappa (l - L) x_ij / l                                  (10)
///   K = kappa [ (1 - L/l) (I - t t^T) + t t^T ],  t = x_ij / l                            (11)
///
/// A spring that goes slack pulls as (10) when longer than L and does nothing when shorter.
///
/// L = 0 is a stitch: ½ kappa l², without a direction to lose when the ends meet.
///
/// @drops  definite: the term 1 - L/l where the spring is shorter than L (it is negative there)
class SeamForce final : public arcsim::Force {
public:
    explicit SeamForce(std::vector<SeamSpring> springs) : springs_(std::move(springs)) {}

    std::string_view name() const override { return "seams"; }
    std::optional<double> energy(const arcsim::State& s) const override;
    void add_gradient(const arcsim::State& s, arcsim::VectorXd& g) const override;
    void add_hessian(const arcsim::State& s, arcsim::Tangent t, arcsim::BlockMatrix& H) const override;
    void list_pairs(std::vector<std::array<int, 2>>& pairs) const override;
    void bind(const arcsim::BlockPattern& p) override;

    /// Largest tension of a spring, N; 0 when all are slack.
    double max_tension(const arcsim::VectorXd& x) const;
    /// Whether a spring pushes when it is shorter than its rest length.
    bool may_push() const;
    /// Largest kappa, N/m.
    double largest_stiffness() const;

private:
    std::vector<SeamSpring> springs_;
    std::vector<arcsim::BlockSlot> slots_;
};

}  // namespace formwork
