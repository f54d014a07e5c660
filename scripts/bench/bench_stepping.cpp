// How much less CPU `static` takes than the best stable linearly implicit stepping in time (backward_euler, SYSTEM row 10)
// to the same residual, from the unstressed rest shape. Steps of several sizes, with the liquid's consistent tangent and
// without it (ArcSim's way); a run that takes more than a hundred times as long as `static` is cut off.
// Usage: bench_stepping SHAPE:FABRIC ... [nodes ...]   default: square:soft sock:soft sock:woven 2500 10000

#include <cctype>
#include <cstdio>

#include "arcsim/solve/linear_solver.hpp"
#include "formwork/equilibrium/equilibrium.hpp"
#include "static_cases.hpp"

using namespace formwork;
using namespace static_cases;

namespace {

struct CutOff {};

/// @returns CPU seconds; infinity where the run failed or was cut off
double row(EquilibriumProblem p, const char* name, double limit_s, const std::vector<Vector3d>* expected, EquilibriumResult* out = nullptr) {
    const double start = arcsim::cpu_seconds();
    const auto spent = [&] { return arcsim::cpu_seconds() - start; };
    double reached = 0;
    p.on_iteration = [&](const IterationReport& r) {
        reached = r.residual;
        if (spent() > limit_s) throw CutOff{};
    };
    std::printf(" %-28s ", name);
    std::fflush(stdout);
    try {
        const EquilibriumResult r = find_equilibrium(p);
        double apart = 0;
        for (std::size_t i = 0; expected && i < r.x.size(); ++i) apart = std::max(apart, (r.x[i] - (*expected)[i]).norm());
        std::printf("%6d %6d %9.1e %8.2f %9.1e\n", r.iterations + r.coarse_iterations, r.factorizations + r.coarse_factorizations,
                    r.residual, r.cpu_s, apart);
        if (out) *out = r;
        return r.cpu_s;
    } catch (const CutOff&) {
        std::printf("cut off after %.1f s at residual %.1e\n", spent(), reached);
    } catch (const arcsim::NumericalError& e) {
        std::printf("%.60s\n", e.what());
    }
    std::fflush(stdout);
    return std::numeric_limits<double>::infinity();
}

}  // namespace

int main(int argc, char** argv) {
    const auto [bags, sizes] = named_cases(argc, argv, {"square:soft", "sock:soft", "sock:woven"}, {2500, 10000});
    const WovenFile file;
    std::printf(" %-28s %6s %6s %9s %8s %9s\n", "method", "steps", "factors", "residual", "cpu s", "apart, m");
    for (const std::string& bag : bags)
        for (const double n : sizes) {
            const std::size_t colon = bag.find(':');
            EquilibriumProblem p = make_problem(bag.substr(0, colon), bag.substr(colon + 1) == "woven", n, file);
            p.fabric_density = 0.2;
            std::printf("%s, %d nodes\n", bag.c_str(), p.rest.n_nodes());
            EquilibriumResult at_rest;
            const double own = row(p, "static", 1e9, nullptr, &at_rest);
            double best = std::numeric_limits<double>::infinity();
            p.solver.method = SolverMethod::backward_euler;
            p.solver.end_time = 1e6;
            p.solver.max_iterations = 100000;
            for (const PressureJacobian jacobian : {PressureJacobian::consistent, PressureJacobian::none})
                for (const double h : {1e-3, 5e-3, 1. / 60, 0.04, 0.1}) {
                    p.pressure_jacobian = jacobian;
                    p.solver.time_step = h;
                    const std::string name = "step " + std::to_string(h).substr(0, 6) +
                                             (jacobian == PressureJacobian::none ? ", no liquid's tangent" : "");
                    best = std::min(best, row(p, name.c_str(), 100 * own, &at_rest.x));
                }
            std::printf(" the best stepping takes %.1f times the CPU of static\n", best / own);
        }
}
