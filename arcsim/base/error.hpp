#pragma once

#include <stdexcept>
#include <string>

namespace arcsim {

/// The input is wrong and the user can mend it. Says where (file and line, or JSON pointer), what was
/// read, and how to mend it. Programs end with exit code 2 and have written nothing over.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The numbers refused: no convergence, no equilibrium, a lost factorisation. Names the step, the face
/// or node and the remedy. Programs end with exit code 3; what was reached is kept and named.
struct NumericalError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The user pressed Ctrl-C: work stopped at a safe point. Programs end with exit code 130.
struct Interrupted : std::runtime_error {
    Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace arcsim
