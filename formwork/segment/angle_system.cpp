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

/// The angles of least energy for the periods as they are and the branches that are nearest now.
/// @returns what faces whose branch is another afterwards save at these angles, rad²
double AngleSystem::solve(FieldState& s) const {
    const FieldProblem& p = problem_;
    std::vector<double> rhs(p.n_faces, 0.0), branch(p.n_faces);
    const auto nearest_branch = [&](int f) { return s.theta[f] - wrap_quarter(s.theta[f] - p.target[f]); };
    for (std::size_t k = 0; k < p.edges.size(); ++k) {
        const DualEdge& e = p.edges[k];
        const double c = e.kappa + quarter_turn * s.period[k];
        rhs[e.i] -= c;
        rhs[e.j] += c;
        if (p.fixed[e.j]) rhs[e.i] += p.target[e.j];
        if (p.fixed[e.i]) rhs[e.j] += p.target[e.i];
    }
    for (int f = 0; f < p.n_faces; ++f) {
        branch[f] = nearest_branch(f);
        rhs[f] = p.fixed[f] ? p.target[f] : rhs[f] + p.weight[f] * branch[f];
    }
    for (int f : p.anchors) rhs[f] += s.theta[f];
    factor_.solve(rhs);
    s.theta.swap(rhs);
    double saved = 0;
    for (int f = 0; f < p.n_faces; ++f) {
        if (!(p.weight[f] > 0) || p.fixed[f]) continue;
        const double b = nearest_branch(f);
        if (std::abs(b - branch[f]) > 0.1) saved += p.weight[f] * (std::pow(s.theta[f] - branch[f], 2) - std::pow(s.theta[f] - b, 2));
    }
    return saved;
}

void AngleSystem::relax(FieldState& s) const {
    constexpr int max_branch_rounds = 20;   // each lowers the energy; two or three suffice
    for (int round = 0; round < max_branch_rounds && solve(s) > 0; ++round) continue;
    s.energy = field_energy(problem_, s.theta, s.period);
}

/// Branches and periods change together: either lowers the energy at the same angles, and one back-substitution serves both.
void AngleSystem::alternate(FieldState& s) const {
    constexpr int max_rounds = 100;         // monotone; 2 to 5 are seen
    constexpr double least_saving = 1e-5;   // rad²: moves of singularities gain a hundred times more
    for (int round = 0; round < max_rounds; ++round) {
        double saved = solve(s);
        for (std::size_t k = 0; k < problem_.edges.size(); ++k) {
            const double r = residual(problem_.edges[k], s.theta, s.period[k]);
            const int step = nearest_quarters(r);
            if (step == 0) continue;   // fixed neighbours keep their period; a residual of exactly 45° stays as it is
            s.period[k] -= step;
            saved += r * r - std::pow(r - step * quarter_turn, 2);
        }
        if (saved < least_saving) break;
    }
    s.energy = field_energy(problem_, s.theta, s.period);
}

}  // namespace formwork
