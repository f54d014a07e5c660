#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <random>

#include "arcsim/force/force.hpp"

/// Checks that every Force has to pass: gradient against energy, exact tangent against gradient by central
/// differences, definite tangent symmetric and without negative eigenvalue.
///
///     check_derivatives(force, state, faces);                    // faces: the mesh's, for the pattern
///     check_derivatives(force, state, faces, {.definite = false});
struct DerivativeCheck {
    double step = 1e-6;           // m; of the differences
    double tolerance = 1e-6;      // relative to the largest entry, or to force / step where that is larger
    bool energy = true;           // when the force has one
    bool exact = true;
    bool definite = true;
};

struct DerivativeErrors {
    double gradient = 0, hessian = 0;   // relative
    double smallest_eigenvalue = 0;     // of the definite tangent, relative to the largest
    double asymmetry = 0;               // of the exact tangent
};

/// The same as numbers, so that a test can ask how wrong something is.
inline DerivativeErrors derivative_errors(arcsim::Force& force, const arcsim::State& state,
                                          const std::vector<arcsim::Triangle>& faces, double step = 1e-6) {
    using namespace arcsim;
    const int n = static_cast<int>(state.x.size());
    std::vector<std::array<int, 2>> pairs;
    force.list_pairs(pairs);
    const BlockPattern pattern(n / 3, faces, pairs);
    force.bind(pattern);
    BlockMatrix exact(pattern, BlockMatrix::Kind::general), definite(pattern);
    VectorXd g = VectorXd::Zero(n);
    force.add_gradient(state, g);
    force.add_hessian(state, Tangent::exact, exact);
    force.add_hessian(state, Tangent::definite, definite);

    VectorXd g_difference = VectorXd::Zero(n);
    MatrixXd H_difference(n, n);
    const bool has_energy = force.energy(state).has_value();
    for (int d = 0; d < n; ++d) {
        State up = state, down = state;
        up.x[d] += step;
        down.x[d] -= step;
        if (has_energy) g_difference[d] = (*force.energy(up) - *force.energy(down)) / (2 * step);
        VectorXd g_up = VectorXd::Zero(n), g_down = VectorXd::Zero(n);
        force.add_gradient(up, g_up);
        force.add_gradient(down, g_down);
        H_difference.col(d) = (g_up - g_down) / (2 * step);
    }
    DerivativeErrors errors;
    const MatrixXd H = exact.dense();
    const double force_scale = std::max(g.cwiseAbs().maxCoeff(), 1e-12);
    const double scale = std::max({H.cwiseAbs().maxCoeff(), 1e-9, 1e-7 * force_scale / step});
    if (has_energy) errors.gradient = (g - g_difference).cwiseAbs().maxCoeff() / std::max(force_scale, scale * step);
    errors.hessian = (H - H_difference).cwiseAbs().maxCoeff() / scale;
    errors.asymmetry = (H - H.transpose()).cwiseAbs().maxCoeff() / scale;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(definite.dense());
    errors.smallest_eigenvalue = eigen.eigenvalues()[0] / std::max(eigen.eigenvalues()[n - 1], 1e-12);
    return errors;
}

inline void check_derivatives(arcsim::Force& force, const arcsim::State& state,
                              const std::vector<arcsim::Triangle>& faces, const DerivativeCheck& c = {}) {
    const DerivativeErrors e = derivative_errors(force, state, faces, c.step);
    INFO("force " << force.name());
    if (c.energy) CHECK(e.gradient <= c.tolerance);
    if (c.exact) CHECK(e.hessian <= c.tolerance);
    if (c.exact && !force.is_unsymmetric()) CHECK(e.asymmetry <= 1e-10);
    if (c.definite) CHECK(e.smallest_eigenvalue >= -1e-10);
}

/// Internal forces neither push nor turn the whole, and a rigid motion turns them along.
/// @param smallest_force  N; states with smaller forces are compared with this
inline void check_invariants(const arcsim::Force& force, const arcsim::State& state, double tolerance = 1e-9,
                             double smallest_force = 1e-3) {
    using namespace arcsim;
    const int n = static_cast<int>(state.x.size());
    VectorXd g = VectorXd::Zero(n);
    force.add_gradient(state, g);
    const double scale = std::max(g.cwiseAbs().maxCoeff(), smallest_force), size = state.x.cwiseAbs().maxCoeff();
    Vector3d sum = Vector3d::Zero(), moment = Vector3d::Zero();
    for (int i = 0; i < n; i += 3) {
        const Vector3d x = state.x.segment<3>(i), f = g.segment<3>(i);
        sum += f;
        moment += x.cross(f);
    }
    INFO("force " << force.name());
    CHECK(sum.norm() <= tolerance * scale);
    CHECK(moment.norm() <= tolerance * scale * size);

    const Matrix3d R = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -3).normalized()).toRotationMatrix();
    State moved = state;
    for (int i = 0; i < n; i += 3) moved.x.segment<3>(i) = R * state.x.segment<3>(i) + Vector3d(0.3, -0.2, 0.1);
    VectorXd g_moved = VectorXd::Zero(n);
    force.add_gradient(moved, g_moved);
    for (int i = 0; i < n; i += 3) g_moved.segment<3>(i) = R.transpose() * g_moved.segment<3>(i);
    // Rounding of the moved positions: relative to the stiffness, hence to the size of the forces' changes.
    CHECK((g_moved - g).cwiseAbs().maxCoeff() <= 1e3 * tolerance * scale);
    if (const auto energy = force.energy(state))
        CHECK(*force.energy(moved) == Approx(*energy).epsilon(1e-6).margin(1e-12));
}
