#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "formwork/segment/period_search.hpp"
#include "tests/formwork/segment/sample_surfaces.hpp"

using namespace formwork;

namespace {

struct Setup {
    Surface s = samples::slab_with_holes(1, 4);
    Topology t = arcsim::build_topology(s);
    FieldProblem problem;
    explicit Setup(double weight, unsigned seed = 7) {
        std::mt19937 random(seed);
        std::normal_distribution<double> noise(0, 0.2);
        std::vector<DirectionData> data(s.n_faces());
        for (int f = 0; f < s.n_faces(); ++f) {
            data[f].theta = arcsim::face_frame(s, f).angle({1, 0.3, 0.2}) + noise(random);
            data[f].weight = weight;
        }
        problem = make_field_problem(s, t, data, {});
    }
};

}  // namespace

TEST_CASE("a partial substitution gives the same quadratic form as a solve") {
    const Setup setup(1);
    const SparseCholesky ordering(setup.problem.pattern);
    const AngleSystem angles(setup.problem, ordering);
    for (const auto& [i, j] : {std::pair{0, 1}, {5, 90}, {33, 34}}) {
        std::vector<double> x(setup.problem.n_faces, 0.0);
        x[i] = 1;
        x[j] = -2;
        angles.factor().solve(x);
        CHECK(angles.factor().energy_norm({{i, 1.0}, {j, -2.0}}) == Approx(x[i] - 2 * x[j]).epsilon(1e-12));
    }
}

TEST_CASE("the energy after changing a period is foretold") {
    const Setup setup(50);   // strong data: no branch changes
    const SparseCholesky ordering(setup.problem.pattern);
    const AngleSystem angles(setup.problem, ordering);
    FieldState state = match_periods(setup.problem, setup.problem.target);
    angles.alternate(state);
    int checked = 0;
    for (std::size_t k = 0; k < setup.problem.edges.size(); k += 97) {
        const DualEdge& e = setup.problem.edges[k];
        FieldState next = state;
        next.period[k] += 1;
        // The data stay on their branch: relax() would move them to the nearest one.
        const double c = quarter_turn, r = residual(e, state.theta, state.period[k]);
        const double foretold = 2 * c * r + c * c * (1 - angles.factor().energy_norm({{e.i, 1.0}, {e.j, -1.0}}));
        angles.relax(next);
        CHECK(next.energy - state.energy <= foretold + 1e-9);
        checked += std::abs(next.energy - state.energy - foretold) < 1e-6;
    }
    CHECK(checked > 3);
}

TEST_CASE("descending never raises the cost and ends where no single period wants to change") {
    const Setup setup(0.5);
    const SparseCholesky ordering(setup.problem.pattern);
    const AngleSystem angles(setup.problem, ordering);
    PeriodSearch search(setup.s, setup.t, angles, 0);
    FieldState state = match_periods(setup.problem, setup.problem.target);
    angles.alternate(state);
    const double before = state.energy;
    search.descend(state);
    CHECK(state.energy < before);
    for (std::size_t k = 0; k < setup.problem.edges.size(); k += 13)
        for (int sign : {-1, 1}) {
            FieldState next = state;
            next.period[k] += sign;
            angles.relax(next);
            CHECK(next.energy > state.energy - 1e-6);
        }
}

TEST_CASE("a price on singularities leaves no more of them") {
    const Setup setup(0.05);
    const SparseCholesky ordering(setup.problem.pattern);
    const AngleSystem angles(setup.problem, ordering);
    int last = 1 << 20;
    for (double price : {0.0, 1.0}) {
        PeriodSearch search(setup.s, setup.t, angles, price);
        FieldState state = match_periods(setup.problem, setup.problem.target);
        search.descend(state);
        int count = 0;
        for (int index4 : search.indices(state)) count += std::abs(index4);
        CHECK(count <= last);
        last = count;
    }
}
