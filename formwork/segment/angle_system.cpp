#include <cmath>

#include "formwork/segment/field_problem.hpp"

namespace formwork {
namespace {

std::vector<double> angle_matrix(const FieldProblem& p) {
    std::vector<double> values(p.pattern.row.size(), 0.0);
    const auto diagonal = [&](int f) -> double& { return values[p.pattern.column[f]]; };
    for (std::size_t k = 0; k < p.edges.size(); ++k) {
        const DualEdge& e = p.edges[k];
        if (!p.fixed[e.i]) diagonal(e.i) += 1;
        if (!p.fixed[e.j]) diagonal(e.j) += 1;
        if (!p.fixed[e.i] && !p.fixed[e.j]) values[p.edge_entry[k]] -= 1;
    }
    for (int f = 0; f < p.n_faces; ++f) {
        if (p.fixed[f]) diagonal(f) = 1;
        else diagonal(f) += p.weight[f];
    }
    for (int f : p.anchors) diagonal(f) += 1;
    return values;
}

}  // namespace

AngleSystem::AngleSystem(const FieldProblem& problem, const SparseCholesky& ordering)
    : problem_(problem), factor_(ordering, 0) {
    factor_.factorize(angle_matrix(problem));
}

void AngleSystem::relax(FieldState& s) const {
    constexpr int max_branch_rounds = 20;   // each lowers the energy; two or three suffice
    const FieldProblem& p = problem_;
    std::vector<double> constant(p.n_faces, 0.0);
    for (std::size_t k = 0; k < p.edges.size(); ++k) {
        const DualEdge& e = p.edges[k];
        const double c = e.kappa + quarter_turn * s.period[k];
        constant[e.i] -= c;
        constant[e.j] += c;
        if (p.fixed[e.j]) constant[e.i] += p.target[e.j];
        if (p.fixed[e.i]) constant[e.j] += p.target[e.i];
    }
    std::vector<double> rhs(p.n_faces), branch(p.n_faces);
    const auto nearest_branch = [&](int f) { return s.theta[f] - wrap_quarter(s.theta[f] - p.target[f]); };
    for (int f = 0; f < p.n_faces; ++f) branch[f] = nearest_branch(f);
    for (int round = 0; round < max_branch_rounds; ++round) {
        for (int f = 0; f < p.n_faces; ++f) rhs[f] = p.fixed[f] ? p.target[f] : constant[f] + p.weight[f] * branch[f];
        for (int f : p.anchors) rhs[f] += s.theta[f];
        factor_.solve(rhs);
        s.theta.swap(rhs);
        bool changed = false;
        for (int f = 0; f < p.n_faces; ++f)
            if (p.weight[f] > 0 && !p.fixed[f]) {
                const double b = nearest_branch(f);
                changed |= std::abs(b - branch[f]) > 0.1;
                branch[f] = b;
            }
        if (!changed) break;
    }
    s.energy = field_energy(p, s.theta, s.period);
}

void AngleSystem::alternate(FieldState& s) const {
    constexpr int max_rounds = 50;          // monotone; 2 to 10 are seen
    for (int round = 0; round < max_rounds; ++round) {
        relax(s);
        bool changed = false;
        for (std::size_t k = 0; k < problem_.edges.size(); ++k) {
            const int step = nearest_quarters(residual(problem_.edges[k], s.theta, s.period[k]));
            // Fixed neighbours keep their period; a residual of exactly 45° stays as it is.
            if (step != 0) {
                s.period[k] -= step;
                changed = true;
            }
        }
        if (!changed) break;
    }
    s.energy = field_energy(problem_, s.theta, s.period);
}

}  // namespace formwork
