#include "formwork/equilibrium/iteration_log.hpp"

#include <limits>

namespace formwork {

double IterationLog::add(IterationReport r, const VectorXd& x) {
    r.max_stretch = system_.membrane().stretch_range(x)[0];
    reports_.push_back(std::move(r));
    if (on_iteration_) on_iteration_(reports_.back());
    return reports_.back().max_stretch;
}

VectorXd rounding_noise(const StaticSystem& system, const VectorXd& x) {
    constexpr double half_ulp = std::numeric_limits<double>::epsilon() / 2;
    VectorXd noise(x.size());
    unsigned state = 12345;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        state = 1664525u * state + 1013904223u;
        noise[i] = half_ulp * x[i] * (2.0 * state / 4294967295.0 - 1);
    }
    system.fixed().clear(noise);
    return noise;
}

}  // namespace formwork
