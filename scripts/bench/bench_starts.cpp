// One equilibrium from every start: the rest shape, a shallow one, one squashed nearly flat, the filled shape blown up by a
// tenth, and the filled shape with every node moved by up to 1 mm. Prints steps and factorisations on the mesh and, behind
// a plus sign, on the coarser ones, and the largest distance of a node from where it ended from rest.
// Usage: bench_starts SHAPE:FABRIC ... [nodes ...]   default: square:soft sock:woven teabag:woven pillow:woven 10000

#include <cctype>
#include <cstdio>
#include <random>

#include "formwork/equilibrium/equilibrium.hpp"
#include "static_cases.hpp"

using namespace formwork;
using namespace static_cases;

namespace {

constexpr double tight = 1e-10;   // residual: shapes are compared to 1e-9 m

std::vector<Vector3d> between(const EquilibriumProblem& p, const EquilibriumResult& filled, double part) {
    std::vector<Vector3d> x = p.rest.x;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += part * (filled.x[i] - x[i]);
    return x;
}

/// Heights above the highest node's drawn to a tenth; held degrees of freedom stay.
std::vector<Vector3d> squashed(const EquilibriumProblem& p) {
    std::vector<Vector3d> x = p.rest.x;
    double top = -1e9;
    for (const auto& q : x) top = std::max(top, q[2]);
    for (std::size_t i = 0; i < x.size(); ++i)
        if (!p.fixed[3 * i + 2]) x[i][2] = top + 0.1 * (x[i][2] - top);
    return x;
}

std::vector<Vector3d> jiggled(const EquilibriumProblem& p, std::vector<Vector3d> x) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> move(-1e-3, 1e-3);
    for (std::size_t i = 0; i < x.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double d = move(random);
            if (!p.fixed[3 * i + c]) x[i][c] += d;
        }
    return x;
}

EquilibriumResult row(const EquilibriumProblem& p, const char* start, const std::vector<Vector3d>* expected) {
    const EquilibriumResult r = find_equilibrium(p);
    double apart = 0;
    for (std::size_t i = 0; expected && i < r.x.size(); ++i) apart = std::max(apart, (r.x[i] - (*expected)[i]).norm());
    std::printf(" %-9s %3d+%-3d %3d+%-3d %8.1e %7.2f %9.1e\n", start, r.iterations, r.coarse_iterations, r.factorizations,
                r.coarse_factorizations, r.residual, r.cpu_s, apart);
    std::fflush(stdout);
    return r;
}

}  // namespace

int main(int argc, char** argv) {
    const auto [bags, sizes] = named_cases(argc, argv, {"square:soft", "sock:woven", "teabag:woven", "pillow:woven"}, {10000});
    const WovenFile file;
    std::printf(" %-9s %7s %7s %8s %7s %9s   tolerance %.0e\n", "start", "steps", "factors", "residual", "cpu s", "apart, m", tight);
    for (const std::string& bag : bags)
        for (const double n : sizes) {
            const std::size_t colon = bag.find(':');
            EquilibriumProblem p = make_problem(bag.substr(0, colon), bag.substr(colon + 1) == "woven", n, file);
            p.solver.tolerance = tight;
            std::printf("%s, %d nodes\n", bag.c_str(), p.rest.n_nodes());
            try {
                const EquilibriumResult filled = row(p, "rest", nullptr);
                p.start = between(p, filled, 0.3);
                row(p, "shallow", &filled.x);
                p.start = squashed(p);
                row(p, "squashed", &filled.x);
                p.start = between(p, filled, 1.1);
                row(p, "overblown", &filled.x);
                p.start = jiggled(p, filled.x);
                row(p, "filled", &filled.x);
            } catch (const std::exception& e) {
                std::printf(" failed: %s\n", e.what());
            }
        }
}
