#include "formwork/equilibrium/run.hpp"

namespace formwork {

EquilibriumError Run::failure(const std::string& text) {
    EquilibriumResult last = result(false);
    return EquilibriumError("equilibrium: " + text + ".", last);
}

/// Tells ballooning from a solver that lost its way: looks for the largest part of the load that has an equilibrium.
/// Bounded: three load steps of 40 iterations.
void Run::explain_failure() {
    const double stretch = system_.membrane().stretch_range(x_)[0];
    if (!is_newton()) {   // load steps would take a method in time too long
        if (outcome_.status == SolveStatus::runaway)
            throw failure("the bag is ballooning, largest stretch " + short_number(stretch) + " and growing. The fabric is too "
                          "soft for this load: lower the fill, take a stiffer fabric, or check the units");
        throw failure(outcome_.reason + "; largest stretch " + short_number(stretch));
    }
    const double residual = outcome_.residual;
    double held = 0, failed = 1;
    VectorXd good = flatten(p_.start.empty() ? p_.rest.x : p_.start);
    for (double fraction : {0.5, 0.25, 0.75}) {
        if (fraction <= held || fraction >= failed || !system_.has_load()) continue;
        VectorXd x = good;
        system_.set_load_factor(fraction);
        method_->allow_iterations(40);
        if (method_->solve(x, 1e-4, held > 0 ? 0 : system_.scales().tension, "load factor " + short_number(fraction)).ok()) {
            held = fraction;
            good = x;
        } else {
            failed = fraction;
        }
    }
    system_.set_load_factor(1);
    x_ = held > 0 ? good : x_;
    std::string text;
    if (outcome_.status == SolveStatus::runaway || stretch > 2.5)
        text = "no equilibrium: the bag is ballooning, largest stretch " + short_number(stretch) +
               " and growing; equilibrium was found up to " + short_number(held) + " of the load, not at " + short_number(failed) +
               ". The fabric is too soft for this load: lower the fill, take a stiffer fabric, or check the units";
    else
        text = "no convergence: residual " + short_number(residual) + " after " + std::to_string(method_->iterations()) +
               " iterations, largest stretch " + short_number(stretch) + "; equilibrium was found up to " + short_number(held) +
               " of the load. Raise solver/max_iterations of this stage, or fill less";
    throw failure(text);
}

}  // namespace formwork
