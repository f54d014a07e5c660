#pragma once

#include <memory>

#include "arcsim/solve/linear_solver.hpp"

namespace arcsim {

std::unique_ptr<LinearSolver> make_cholmod();
std::unique_ptr<LinearSolver> make_umfpack();
std::unique_ptr<LinearSolver> make_eigen_ldlt();
std::unique_ptr<LinearSolver> make_supernodal();
std::unique_ptr<LinearSolver> make_single();
std::unique_ptr<LinearSolver> make_mixed();
std::unique_ptr<LinearSolver> make_pcg();

}  // namespace arcsim
