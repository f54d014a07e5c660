#include "check_force.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <random>

using namespace arcsim;

DerivativeErrors check_derivatives(Force& force, const std::vector<Triangle>& faces, const State& s, double step) {
    const int n = static_cast<int>(s.x.size());
    std::vector<std::array<int, 2>> pairs;
    force.list_pairs(pairs);
    const BlockPattern pattern(n / 3, faces, pairs);
    force.bind(pattern);
    BlockMatrix H(pattern, BlockMatrix::Kind::general);
    force.add_hessian(s, Tangent::exact, H);
    const MatrixXd K = H.dense();
    VectorXd g = VectorXd::Zero(n);
    force.add_gradient(s, g);

    DerivativeErrors r;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int trial = 0; trial < 3; ++trial) {
        const VectorXd d = VectorXd::NullaryExpr(n, [&] { return uniform(random); });
        State a = s, b = s;
        a.x += step * d;
        b.x -= step * d;
        VectorXd ga = VectorXd::Zero(n), gb = VectorXd::Zero(n);
        force.add_gradient(a, ga);
        force.add_gradient(b, gb);
        const VectorXd difference = (ga - gb) / (2 * step);
        r.hessian = std::max(r.hessian, (K * d - difference).norm() / std::max(difference.norm(), 1e-12));
        if (const auto ea = force.energy(a), eb = force.energy(b); ea && eb)
            r.gradient = std::max(r.gradient, std::abs((*ea - *eb) / (2 * step) - g.dot(d)) / (g.norm() * d.norm()));
    }
    r.asymmetry = (K - K.transpose()).norm() / std::max(K.norm(), 1e-300);
    BlockMatrix D(pattern);
    force.add_hessian(s, Tangent::definite, D);
    const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(D.dense()).eigenvalues();
    r.lowest = eigenvalues[0] / std::max(eigenvalues[n - 1], 1e-300);
    return r;
}
