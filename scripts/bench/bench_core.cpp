// Cost of one cloth step on one thread: the free swing of arcsim's hang case on square sheets.
// Usage: bench_core [--order amd|metis|automatic] [--solver mixed|cholmod] [--steps N] [size ...]
// Default sizes 21 41 101 161. "of peak": of a large matrix product in the factor's precision.
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "arcsim/mesh/obj_io.hpp"
#include "arcsim/scene/simulation.hpp"
#include "arcsim/solve/linear_solver.hpp"

using namespace arcsim;

extern "C" {
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*, const int*,
            const double*, const int*, const double*, double*, const int*);
void sgemm_(const char*, const char*, const int*, const int*, const int*, const float*, const float*, const int*,
            const float*, const int*, const float*, float*, const int*);
}

namespace {

/// GFlop/s of a large matrix product: what the machine can do at best.
template <class Real>
double gemm_peak() {
    constexpr int n = 1200;
    std::vector<Real> a(n * n, 1), b(n * n, 1), c(n * n, 0);
    const Real one = 1, zero = 0;
    double best = 0;
    for (int repeat = 0; repeat < 3; ++repeat) {
        const double start = cpu_seconds();
        if constexpr (sizeof(Real) == 4)
            sgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, b.data(), &n, &zero, c.data(), &n);
        else
            dgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, b.data(), &n, &zero, c.data(), &n);
        best = std::max(best, 2e-9 * n * n * n / (cpu_seconds() - start));
    }
    return best;
}

/// n x n nodes, 1 m wide, alternating diagonals: the sheet of the reference measurements.
ClothMesh sheet(int n) {
    ClothMesh m;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const Vector2d u(double(i) / (n - 1), double(j) / (n - 1));
            m.add_vert(u);
            m.add_node({u.x() - 0.5, u.y() - 1, 0});
        }
    for (int j = 0; j + 1 < n; ++j)
        for (int i = 0; i + 1 < n; ++i) {
            const int a = j * n + i, b = a + 1, c = a + n + 1, d = a + n;
            const std::vector<Triangle> pair = (i + j) % 2 == 0 ? std::vector<Triangle>{{a, b, c}, {a, c, d}}
                                                                : std::vector<Triangle>{{a, b, d}, {b, c, d}};
            for (const Triangle& t : pair) m.add_face(t, t);
        }
    return m;
}

SceneParams hanging_sheet(int n, const std::filesystem::path& folder) {
    write_obj(folder / "sheet.obj", sheet(n));
    std::ofstream(folder / "iso.json") << "{\"density\": 0.2, \"stretching\": [[300,2,300,37.5],[600,2,600,75],"
                                          "[600,2,600,75],[600,2,600,75],[600,2,600,75],[600,2,600,75]],"
                                          "\"bending\": [[1e-6,1e-6,1e-6,1e-6,1e-6],[1e-6,1e-6,1e-6,1e-6,1e-6],"
                                          "[1e-6,1e-6,1e-6,1e-6,1e-6]]}";
    SceneParams p;
    p.frame_time = 0.01;
    ClothParams cloth;
    cloth.mesh = {"sheet.obj", folder / "sheet.obj"};
    ClothMaterialParams material;
    material.data = {"iso.json", folder / "iso.json"};
    cloth.materials = {material};
    p.cloths = {cloth};
    HandleParams handle;
    handle.nodes = {n * (n - 1), n * n - 1};
    p.handles = {handle};
    p.gravity = {0, 0, -9.81};
    p.wind.density = 0;
    p.magic.handle_stiffness = 1e6;
    return p;
}

double peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * usage.ru_maxrss;
}

void measure(int n, int steps, FillOrder order, SolverKind solver, double dgemm, double sgemm) {
    std::string name = (std::filesystem::temp_directory_path() / "bench_core_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error(name + ": cannot make this folder. Set TMPDIR to one that can be written.");
    const std::filesystem::path folder = name;
    SceneParams scene = hanging_sheet(n, folder);
    scene.solver.linear_solver = solver;
    const std::vector<Motion> no_motions;
    const double idle_memory = peak_memory_bytes();
    const double start = cpu_seconds();
    Simulation simulation(scene, no_motions);
    RunningCloth& cloth = simulation.cloths()[0];
    if (order != FillOrder::automatic) cloth.stepper = make_stepper(cloth.model, scene.solver, order);
    const double setup = cpu_seconds() - start;
    simulation.step();   // warms caches; the first factorisation allocates
    const StepCost first = cloth.stepper->cost();
    const double begin = cpu_seconds();
    for (int i = 0; i < steps; ++i) simulation.step();
    const double per_step = 1e3 * (cpu_seconds() - begin) / steps;
    const StepCost& all = cloth.stepper->cost();
    const double assembly = 1e3 * (all.assembly - first.assembly) / steps;
    const double factor = 1e3 * (all.factor - first.factor) / steps;
    const double solve = 1e3 * (all.solve - first.solve) / steps;
    const FactorCost& cost = cloth.stepper->system().solver().cost();
    std::printf("%4d^2 %8d %9.2f %9.2f %5.1f%% %9.2f %8.2f %7.2f %9.3f %7.1f%% %7.1f%% %9.0f %8.0f\n", n, 3 * n * n, per_step,
                assembly, 100 * assembly / per_step, factor, solve, per_step - assembly - factor - solve,
                1e-9 * cost.flops, 100e-6 * cost.flops / factor / dgemm, 100e-6 * cost.flops / factor / sgemm, 1e3 * setup,
                (peak_memory_bytes() - idle_memory) / (n * n));
    std::fflush(stdout);
    std::filesystem::remove_all(folder);
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<int> sizes;
    FillOrder order = FillOrder::automatic;
    SolverKind solver = SolverKind::mixed;
    int steps = 20;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--order" && i + 1 < argc) {
            const std::string name = argv[++i];
            order = name == "amd" ? FillOrder::amd : name == "metis" ? FillOrder::metis : FillOrder::automatic;
        } else if (word == "--solver" && i + 1 < argc) {
            const std::string name = argv[++i];
            solver = name == "cholmod" ? SolverKind::cholmod : name == "pcg" ? SolverKind::pcg : SolverKind::mixed;
        } else if (word == "--steps" && i + 1 < argc) {
            steps = std::atoi(argv[++i]);
        } else if (std::atoi(word.c_str()) > 1) {
            sizes.push_back(std::atoi(word.c_str()));
        } else {
            std::fprintf(stderr, "bench_core: %s: expected nodes along a side (21 41 101 161), --steps N, --order amd|metis, --solver mixed|cholmod|pcg\n",
                         word.c_str());
            return 2;
        }
    }
    if (sizes.empty()) sizes = {21, 41, 101, 161};
    set_blas_threads(1);
    const double dgemm = gemm_peak<double>(), sgemm = gemm_peak<float>();
    malloc_trim(0);   // or the children's peak memory would hide in what these matrices leave behind
    std::printf("BLAS kernel %s, dgemm %.1f and sgemm %.1f GFlop/s on one thread; %d steps of h = 0.01 s\n",
                blas_kernel().c_str(), dgemm, sgemm, steps);
    std::printf("%6s %8s %9s %9s %6s %9s %8s %7s %9s %8s %8s %9s %8s\n", "sheet", "unknowns", "ms/step", "assembly", "", "factor",
                "solve", "rest", "GFlop", "of dgemm", "of sgemm", "setup ms", "B/node");
    std::fflush(stdout);
    for (const int n : sizes) {   // each in its own process, for its own peak memory
        const pid_t child = fork();
        if (child == 0) {
            measure(n, steps, order, solver, dgemm, sgemm);
            std::_Exit(0);
        }
        waitpid(child, nullptr, 0);
    }
    return 0;
}
