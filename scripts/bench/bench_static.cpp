// Equilibria of filled bags from their unstressed rest shape: iterations, factorisations, CPU seconds by kind of work,
// memory, the ratio to one CHOLMOD ordering + analysis + factorisation + solve of the same matrix in the same run, and the
// exponent of the growth with the number of nodes. Every case runs in processes of its own, one with one thread and one
// with two, so that its peak memory is its own.
// Usage: bench_static [shape | soft | woven ...] [nodes ...]   default: disk sock column, soft woven, 1000 10000 40000 160000

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <cstdio>
#include <functional>
#include <map>

#include "arcsim/solve/fill_order.hpp"
#include "arcsim/solve/linear_solver.hpp"
#include "static_cases.hpp"

using namespace formwork;
using namespace static_cases;

namespace {

/// CPU seconds of one ordering + analysis + factorisation + solve of a matrix with the problem's pattern.
double one_direct_solve(const EquilibriumProblem& p) {
    StaticSystem system(p);
    system.membrane().law().set_regulariser({0, 1});
    BlockMatrix H(system.pattern());
    VectorXd border;
    system.tangent(flatten(p.rest.x), 1e3, H, border, arcsim::Tangent::definite);
    const double start = arcsim::cpu_seconds();
    const auto solver = arcsim::make_linear_solver(arcsim::SolverKind::cholmod);
    solver->analyze(system.pattern());
    solver->factorize(H);
    (void)solver->solve(VectorXd::Ones(system.pattern().n_dofs()));
    return arcsim::cpu_seconds() - start + system.ordering_s();
}

struct Figures {
    bool ok = false;
    double direct = 0;
    int nodes = 0, iterations = 0, factorizations = 0, coarse_iterations = 0, coarse_factorizations = 0;
    double residual = 0, cpu = 0, wall = 0, peak_mb = 0;
    SolverTimes times;
    char failure[160] = "";
};

double peak_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// What `work` found in a process of its own.
Figures in_own_process(const std::function<void(Figures&)>& work) {
    int ends[2];
    Figures f;
    if (pipe(ends) != 0) return f;
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        try {
            work(f);
            f.ok = true;
        } catch (const std::exception& e) {
            std::snprintf(f.failure, sizeof f.failure, "%s", e.what());
        }
        const bool sent = write(ends[1], &f, sizeof f) == sizeof f;
        _exit(sent ? 0 : 1);
    }
    close(ends[1]);
    if (read(ends[0], &f, sizeof f) != sizeof f) std::snprintf(f.failure, sizeof f.failure, "the process ended early");
    close(ends[0]);
    waitpid(child, nullptr, 0);
    return f;
}

Figures solve(const std::string& kind, bool woven, double nodes, const WovenFile& file, int threads) {
    return in_own_process([&](Figures& f) {
        EquilibriumProblem p = make_problem(kind, woven, nodes, file);
        p.solver.threads = threads;
        f.nodes = p.rest.n_nodes();
        const EquilibriumResult r = find_equilibrium(p);
        f.iterations = r.iterations;
        f.factorizations = r.factorizations;
        f.coarse_iterations = r.coarse_iterations;
        f.coarse_factorizations = r.coarse_factorizations;
        f.residual = r.residual;
        f.cpu = r.cpu_s;
        f.wall = r.wall_s;
        f.times = r.times;
        f.peak_mb = peak_mb();
    });
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<double> sizes;
    std::vector<std::string> shapes, fabrics;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "soft" || word == "woven") fabrics.push_back(word);
        else if (std::isdigit(static_cast<unsigned char>(word[0]))) sizes.push_back(std::stod(word));
        else shapes.push_back(word);
    }
    if (sizes.empty()) sizes = {1000, 10000, 40000, 160000};
    if (shapes.empty()) shapes = {"disk", "sock", "column"};
    if (fabrics.empty()) fabrics = {"soft", "woven"};
    const WovenFile file;
    const double empty_mb = in_own_process([](Figures& f) { f.peak_mb = peak_mb(); }).peak_mb;
    std::printf("BLAS kernel %s; tolerance 1e-6; seconds; an empty process takes %.0f MB, which kB/node includes\n",
                arcsim::blas_kernel().c_str(), empty_mb);
    std::printf("%-6s %-5s %7s %4s %4s %4s %4s %8s %8s %8s %8s %8s %8s %8s %8s %8s %8s %8s %8s %7s %8s %6s\n", "shape", "cloth", "nodes",
                "it", "fact", "c.it", "c.f", "residual", "cpu", "wall", "2t cpu", "2t wall", "coarse", "assembly", "order", "symbolic",
                "numeric", "solve", "search", "ratio", "kB/node", "growth");
    std::map<std::string, Figures> previous;
    for (const std::string& kind : shapes)
        for (const std::string& fabric : fabrics)
            for (const double n : sizes) {
                const bool woven = fabric == "woven";
                const Figures direct = in_own_process([&](Figures& f) { f.direct = one_direct_solve(make_problem(kind, woven, n, file)); });
                const Figures r = solve(kind, woven, n, file, 1), two = solve(kind, woven, n, file, 2);
                if (!r.ok || !direct.ok) {
                    std::printf("%-6.6s %-5s %7d failed: %s\n", kind.c_str(), fabric.c_str(), r.nodes, r.ok ? direct.failure : r.failure);
                    continue;
                }
                Figures& before = previous[kind + fabric];
                const double growth = before.ok ? std::log(r.cpu / before.cpu) / std::log(double(r.nodes) / before.nodes) : 0;
                before = r;
                const auto& t = r.times;
                std::printf("%-6.6s %-5s %7d %4d %4d %4d %4d %8.1e %8.3f %8.3f %8.3f %8.3f %8.3f %8.3f %8.3f %8.3f %8.3f %8.3f %8.3f %7.2f %8.2f %6.2f\n",
                            kind.c_str(), fabric.c_str(), r.nodes, r.iterations, r.factorizations, r.coarse_iterations,
                            r.coarse_factorizations, r.residual, r.cpu, r.wall, two.cpu, two.wall, t.coarse, t.assembly, t.ordering,
                            t.symbolic, t.numeric, t.solve, t.line_search, r.cpu / direct.direct, r.peak_mb * 1024 / r.nodes, growth);
                std::fflush(stdout);
            }
}
