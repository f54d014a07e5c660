#pragma once

#include <functional>
#include <vector>

#include "formwork/equilibrium/static_system.hpp"

namespace formwork {

/// The reports of a method's iterations, shown as they come.
class IterationLog {
public:
    IterationLog(StaticSystem& system, std::function<void(const IterationReport&)> on_iteration)
        : system_(system), on_iteration_(std::move(on_iteration)) {}

    /// @param r  its largest stretch is measured here
    /// @returns the largest stretch at x
    double add(IterationReport r, const VectorXd& x);
    const std::vector<IterationReport>& reports() const { return reports_; }

private:
    StaticSystem& system_;
    std::function<void(const IterationReport&)> on_iteration_;
    std::vector<IterationReport> reports_;
};

/// Change of every free coordinate by up to half a unit in its last place, at random but always the same: what it does to
/// the forces is the floor that rounding sets.
VectorXd rounding_noise(const StaticSystem& system, const VectorXd& x);

}  // namespace formwork
