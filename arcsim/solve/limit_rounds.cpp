#include "arcsim/solve/limit_rounds.hpp"

#include <cmath>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"

namespace arcsim {
namespace {

constexpr int max_rounds = 40;

/// Each round divides the gap by about 1 + penalty / stiffness: ten times what resists a stretch of the whole
/// cloth within a step, its fabric and its inertia.
double first_penalty(const ClothModel& model, double h) {
    double area = 0;
    for (const StretchFace& f : model.stretch->faces()) area += f.area;
    const double density = model.mass.sum() / area, length = model.size / h;
    return 10 * (model.stretch->rest_stiffness() + density * length * length);
}

}  // namespace

LimitRounds::LimitRounds(ClothModel& model, double h) : model_(model), gap_(INFINITY) {
    const double penalty = first_penalty(model, h);
    largest_penalty_ = 1e4 * penalty;
    model.limits->set_penalty(penalty);
}

bool LimitRounds::are_done(const VectorXd& x) {
    StrainLimitForce& limits = *model_.limits;
    const auto worst = limits.worst(x);   // before `update` forgets what this solve was asked for
    const double gap = limits.update(x);
    if (gap <= tolerance) return true;
    const bool is_slow = gap > 0.25 * gap_;
    if (++round_ == max_rounds || (is_slow && limits.penalty() >= largest_penalty_))
        throw NumericalError("the strain limits cannot be met: face " + std::to_string(worst.face) + " is stretched " +
                             format_short(worst.stretch) + " times, " + format_short(worst.beyond) +
                             " beyond its limit. Something pulls or presses the cloth further (handles?), or /materials/strain_limits are too narrow");
    if (is_slow) limits.set_penalty(10 * limits.penalty());
    gap_ = gap;
    return false;
}

}  // namespace arcsim
