#pragma once

#include "arcsim/force/force.hpp"

/// Central differences against a force's own derivatives, on a small mesh.
struct DerivativeErrors {
    double gradient = 0;    // dE/dx against the gradient, relative; 0 without a potential
    double hessian = 0;     // dg/dx against the exact tangent times a random direction, relative
    double asymmetry = 0;   // of the exact tangent, Frobenius, relative
    double lowest = 0;      // lowest eigenvalue of the definite tangent over its largest
};

DerivativeErrors check_derivatives(arcsim::Force& force, const std::vector<arcsim::Triangle>& faces,
                                   const arcsim::State& s, double step = 1e-6);
