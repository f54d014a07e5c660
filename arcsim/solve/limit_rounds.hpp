#pragma once

#include "arcsim/force/cloth_model.hpp"

namespace arcsim {

/// The rounds of an augmented Lagrangian: solve with the multipliers held, put them right, until bounds and
/// multipliers fit each other to `tolerance` of strain.
class LimitRounds {
public:
    static constexpr double tolerance = 1e-6;   // of strain

    /// For one step of `h` s. Keeps a reference to the model, whose `limits` must exist.
    LimitRounds(ClothModel& model, double h);

    /// After a solve that ended at x. @throws NumericalError naming the face: the bounds cannot be met
    bool are_done(const VectorXd& x);

private:
    ClothModel& model_;
    double largest_penalty_, gap_;
    int round_ = 0;
};

}  // namespace arcsim
