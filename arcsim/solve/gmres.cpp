#include "arcsim/solve/gmres.hpp"

#include <cmath>

namespace arcsim {

GmresOutcome FactorGmres::solve(const std::function<void(const VectorXd&, VectorXd&)>& multiply, const LinearSolver& factor,
                                const VectorXd& b, double tolerance, int max_iterations, VectorXd& x) {
    x.setZero(b.size());
    const double size = b.norm();
    if (!(size > 0)) return {true, 0};
    basis_.resize(std::max<std::size_t>(basis_.size(), 1));
    basis_[0] = b / size;
    MatrixXd R = MatrixXd::Zero(max_iterations + 1, max_iterations);   // Hessenberg, turned triangular as it grows
    VectorXd cosine(max_iterations), sine(max_iterations), rest = VectorXd::Zero(max_iterations + 1);
    rest[0] = size;
    int n = 0;
    bool converged = false;
    while (n < max_iterations && !converged) {
        const int k = n++;
        factor.solve(basis_[k], z_);
        multiply(z_, w_);
        for (int i = 0; i <= k; ++i) {   // modified Gram-Schmidt
            R(i, k) = basis_[i].dot(w_);
            w_ -= R(i, k) * basis_[i];
        }
        const double next = w_.norm();
        if (!std::isfinite(next)) {
            --n;
            break;
        }
        for (int i = 0; i < k; ++i) {
            const double upper = R(i, k), lower = R(i + 1, k);
            R(i, k) = cosine[i] * upper + sine[i] * lower;
            R(i + 1, k) = cosine[i] * lower - sine[i] * upper;
        }
        const double length = std::hypot(R(k, k), next);
        if (!(length > 0)) {
            --n;
            break;
        }
        cosine[k] = R(k, k) / length;
        sine[k] = next / length;
        R(k, k) = length;
        rest[k + 1] = -sine[k] * rest[k];
        rest[k] *= cosine[k];
        converged = std::abs(rest[k + 1]) <= tolerance * size;
        if (converged || n == max_iterations) break;
        if (basis_.size() < static_cast<std::size_t>(n) + 1) basis_.emplace_back();
        basis_[n] = w_ / next;
    }
    if (n == 0) return {false, 0};
    const VectorXd y = R.topLeftCorner(n, n).triangularView<Eigen::Upper>().solve(rest.head(n));
    w_ = y[0] * basis_[0];
    for (int i = 1; i < n; ++i) w_ += y[i] * basis_[i];
    factor.solve(w_, x);
    return {converged, n};
}

}  // namespace arcsim
