#include <cmath>

#include "formwork/segment/field_problem.hpp"

namespace formwork {

PowerField::PowerField(const FieldProblem& problem, const SparseCholesky& ordering)
    : problem_(problem), ordering_(ordering) {}

std::vector<Complex> PowerField::matrix(double shift) const {
    const FieldProblem& p = problem_;
    std::vector<Complex> values(p.pattern.row.size(), 0.0);
    const auto diagonal = [&](int f) -> Complex& { return values[p.pattern.column[f]]; };
    for (std::size_t k = 0; k < p.edges.size(); ++k) {
        const DualEdge& e = p.edges[k];
        if (!p.fixed[e.i]) diagonal(e.i) += 1.0;
        if (!p.fixed[e.j]) diagonal(e.j) += 1.0;
        if (p.fixed[e.i] || p.fixed[e.j]) continue;
        // |z_j - g z_i|²: row j, column i holds -g; CHOLMOD reads the lower triangle only.
        const Complex g = std::polar(1.0, 4 * e.kappa);
        values[p.edge_entry[k]] -= e.j > e.i ? g : std::conj(g);
    }
    for (int f = 0; f < p.n_faces; ++f) {
        if (p.fixed[f]) diagonal(f) = 1.0;
        else diagonal(f) += p.weight[f] + shift;
    }
    return values;
}

void PowerField::add_fixed_neighbours(std::vector<Complex>& rhs) const {
    const FieldProblem& p = problem_;
    for (const DualEdge& e : p.edges) {
        if (p.fixed[e.i] == p.fixed[e.j]) continue;
        const Complex g = std::polar(1.0, 4 * e.kappa);
        if (p.fixed[e.i]) rhs[e.j] += g * std::polar(1.0, 4 * p.target[e.i]);
        else rhs[e.i] += std::conj(g) * std::polar(1.0, 4 * p.target[e.j]);
    }
    for (int f = 0; f < p.n_faces; ++f)
        if (p.fixed[f]) rhs[f] = std::polar(1.0, 4 * p.target[f]);
}

std::vector<Complex> PowerField::linear() const {
    const FieldProblem& p = problem_;
    std::vector<Complex> z(p.n_faces);
    if (!p.has_data) {                      // nothing to follow: any start will do for diffuse()
        for (int f = 0; f < p.n_faces; ++f) z[f] = 1.0;
        return z;
    }
    constexpr double regular = 1e-9;        // a patch without data on a flat region
    SparseCholesky factor(ordering_, 0);
    factor.factorize(matrix(regular));
    for (int f = 0; f < p.n_faces; ++f) z[f] = p.weight[f] * std::polar(1.0, 4 * p.target[f]);
    add_fixed_neighbours(z);
    factor.solve(z);
    return z;
}

std::vector<Complex> PowerField::diffuse(std::vector<Complex> z, double tau, int max_steps) const {
    constexpr double enough = 1e-3;         // relative change of the field between steps
    const FieldProblem& p = problem_;
    SparseCholesky factor(ordering_, 0);
    factor.factorize(matrix(1 / tau));
    std::vector<Complex> data(p.n_faces, 0.0), next(p.n_faces);
    for (int f = 0; f < p.n_faces; ++f) data[f] = p.weight[f] * std::polar(1.0, 4 * p.target[f]);
    const auto normalise = [](Complex& c) {
        const double length = std::abs(c);
        c = length > 1e-30 ? c / length : Complex(1.0);
    };
    for (Complex& c : z) normalise(c);
    for (int step = 0; step < max_steps; ++step) {
        for (int f = 0; f < p.n_faces; ++f) next[f] = data[f] + z[f] / tau;
        add_fixed_neighbours(next);
        factor.solve(next);
        double change = 0;
        for (int f = 0; f < p.n_faces; ++f) {
            normalise(next[f]);
            change += std::norm(next[f] - z[f]);
        }
        z.swap(next);
        if (change < enough * enough * p.n_faces) break;
    }
    return z;
}

std::vector<double> angles_of(const std::vector<Complex>& z) {
    std::vector<double> theta(z.size());
    for (std::size_t f = 0; f < z.size(); ++f) theta[f] = std::arg(z[f]) / 4;
    return theta;
}

}  // namespace formwork
