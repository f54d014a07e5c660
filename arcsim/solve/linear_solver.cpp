#include "arcsim/solve/linear_solver.hpp"

#include <ctime>

#include "arcsim/base/error.hpp"
#include "arcsim/solve/own_factor.hpp"
#include "arcsim/solve/solvers.hpp"

// Present only when the BLAS is OpenBLAS.
extern "C" {
__attribute__((weak)) char* openblas_get_corename();
__attribute__((weak)) void openblas_set_num_threads(int);
}

namespace arcsim {

void LinearSolver::factorize(const BlockMatrix& A) {
    if (try_factorize(A)) return;
    throw NumericalError(std::string(name()) + ": the matrix is not positive definite at node " +
                         std::to_string(breakdown_.node) + ", axis " + std::to_string(breakdown_.axis) +
                         ": a part of the cloth is free to move, slack, or unstable there. Hold more nodes, or "
                         "take a smaller step");
}

std::unique_ptr<LinearSolver> make_linear_solver(SolverKind kind) {
    switch (kind) {
        case SolverKind::cholmod: return make_cholmod();
        case SolverKind::umfpack: return make_umfpack();
        case SolverKind::eigen_ldlt: return make_eigen_ldlt();
        case SolverKind::supernodal: return make_supernodal();
        case SolverKind::single: return make_single();
        case SolverKind::mixed: return make_mixed();
        case SolverKind::pcg: return make_pcg();
        case SolverKind::automatic: return own_factor_is_quick ? make_mixed() : make_cholmod();
    }
    return nullptr;
}

double cpu_seconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

std::string blas_kernel() { return openblas_get_corename ? openblas_get_corename() : "unknown"; }

void set_blas_threads(int n) {
    if (openblas_set_num_threads) openblas_set_num_threads(n);
}

}  // namespace arcsim
