// Equilibria of filled disks, socks and columns from their unstressed rest shape: iterations, factorisations, CPU seconds by
// kind of work, memory, and the ratio to one CHOLMOD analysis + factorisation + solve of the same matrix in the same run.
// B/node is the peak of the process so far: meaningful for the largest mesh only.
// Shapes: disk, sock, column (first on the page of measurements); square, pillow and teabag wrinkle.
// Usage: bench_static [shape | soft | woven ...] [nodes ...]   default: disk sock column, soft woven, 1000 10000 40000

#include <unistd.h>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "arcsim/solve/fill_order.hpp"
#include "arcsim/solve/linear_solver.hpp"
#include "formwork/equilibrium/static_system.hpp"
#include "formwork/mesher/mesh_kinds.hpp"

using namespace formwork;

namespace {

bool on_border(const Vector3d& x) { return x[0] < 1e-9 || x[1] < 1e-9 || x[0] > 0.3 - 1e-9 || x[1] > 0.3 - 1e-9; }

Surface make_mesh(const std::string& kind, double nodes) {
    const double triangle = std::sqrt(3.) / 2;   // area per node of an equilateral mesh, edge 1
    const auto edge = [&](double area) { return std::sqrt(area / nodes / triangle); };
    if (kind == "disk") return make_disk({.radius = 0.15, .edge = edge(M_PI * 0.15 * 0.15)});
    if (kind == "sock") return make_sock({.radius = 0.1, .height = 0.4, .edge = edge(M_PI * 0.1 * 0.9)});
    if (kind == "square" || kind == "teabag") return make_strip({.length = 0.3, .width = 0.3, .edge = edge(0.09)});
    if (kind == "pillow") {   // two squares sewn along their edges, as two flat sheets of opposite sides
        const Surface sheet = make_strip({.length = 0.3, .width = 0.3, .edge = edge(0.18)});
        Surface s = sheet;
        std::vector<int> twin(sheet.x.size());
        for (std::size_t i = 0; i < sheet.x.size(); ++i) {
            const bool border = on_border(sheet.x[i]);
            twin[i] = border ? static_cast<int>(i) : static_cast<int>(s.x.size());
            const double bulge = 1e-3 * std::sin(M_PI * sheet.x[i][0] / 0.3) * std::sin(M_PI * sheet.x[i][1] / 0.3);
            if (!border) s.x.push_back(sheet.x[i] - Vector3d(0, 0, bulge)), s.x[i][2] = bulge;
        }
        for (const auto& t : sheet.faces) s.faces.push_back({twin[t[0]], twin[t[2]], twin[t[1]]});
        for (auto& x : s.x) x = Vector3d(x[0], x[2], x[1] - 0.3);   // hung: its upper edge at z = 0
        for (auto& t : s.faces) std::swap(t[1], t[2]);
        return s;
    }
    ColumnSize size;
    size.edge = edge(0.11);
    return make_column(size);
}

std::filesystem::path woven_file() {
    const auto file = std::filesystem::temp_directory_path() / ("bench_static_woven_" + std::to_string(getpid()) + ".json");
    std::ofstream out(file);
    out << R"({"density": 0.2, "bending": [[0,0,0,0,0],[0,0,0,0,0],[0,0,0,0,0]], "stretching": [)";
    for (int i = 0; i < 6; ++i) out << (i ? "," : "") << "[450000, 25, 500000, 10800]";
    out << "]}";
    return file;
}

int nearest(const Surface& s, const Vector3d& at) {
    int best = 0;
    for (int i = 0; i < s.n_nodes(); ++i)
        if ((s.x[i] - at).norm() < (s.x[best] - at).norm()) best = i;
    return best;
}

EquilibriumProblem make_problem(const std::string& kind, bool woven, double nodes, const std::filesystem::path& file) {
    EquilibriumProblem p;
    p.rest = make_mesh(kind, nodes);
    double top = -1e9, bottom = 1e9;
    for (const auto& x : p.rest.x) top = std::max(top, x[2]), bottom = std::min(bottom, x[2]);
    p.fixed.assign(3 * p.rest.x.size(), 0);
    for (std::size_t i = 0; i < p.rest.x.size(); ++i) {
        const bool rim = kind == "disk"     ? p.rest.x[i].head<2>().norm() > 0.15 - 1e-9
                         : kind == "square" ? on_border(p.rest.x[i])
                                            : p.rest.x[i][2] > top - 1e-9;
        for (int c = 0; c < 3; ++c) p.fixed[3 * i + c] = rim;
        if (kind == "teabag") {   // the mirror half: its border moves in its own plane, two nodes keep it in place
            for (int c = 0; c < 3; ++c) p.fixed[3 * i + c] = c == 2 && on_border(p.rest.x[i]);
        }
    }
    if (kind == "teabag") {
        const int middle = nearest(p.rest, {0.15, 0.15, 0}), side = nearest(p.rest, {0.3, 0.15, 0});
        p.fixed[3 * middle] = p.fixed[3 * middle + 1] = p.fixed[3 * side + 1] = 1;
        p.plaster.overpressure = 2000;
    } else {
        p.plaster.density = 1500;
        p.plaster.fill = FillParams{};
        p.plaster.fill->level = kind == "sock" ? (woven ? top - 0.05 : 0.5 * (top + bottom))
                                : kind == "square" || kind == "pillow" ? top + 0.05 : top;
    }
    p.self_weight = false;
    p.solver.tolerance = 1e-6;
    if (woven) {
        p.material.model = FabricModel::tensor;
        p.material.data = {"woven", file};
        p.material.stretching_mult = 0.5;
        for (const auto& t : p.rest.faces) {   // one weave frame around the bag: v as near to the vertical as the face allows
            Vector3d n = (p.rest.x[t[1]] - p.rest.x[t[0]]).cross(p.rest.x[t[2]] - p.rest.x[t[0]]).normalized();
            Vector3d v = Vector3d(0, 0, 1) - n[2] * n;
            if (v.norm() < 0.3) v = Vector3d(0, 1, 0) - n[1] * n;
            v.normalize();
            const Vector3d u = v.cross(n);
            FlatTriangle flat;
            for (int k = 0; k < 3; ++k) flat[k] = {p.rest.x[t[k]].dot(u), p.rest.x[t[k]].dot(v)};
            p.flat.push_back(flat);
        }
    }
    return p;
}

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
    if (sizes.empty()) sizes = {1000, 10000, 40000};
    if (shapes.empty()) shapes = {"disk", "sock", "column"};
    if (fabrics.empty()) fabrics = {"soft", "woven"};
    const auto file = woven_file();
    std::printf("BLAS kernel %s; tolerance 1e-6; CPU seconds\n", arcsim::blas_kernel().c_str());
    std::printf("%-5s %-6s %7s %4s %4s %4s %4s %8s %8s %8s %8s %8s %8s %8s %8s %8s %7s %9s %6s\n", "shape", "fabric", "nodes", "it", "fact", "c.it", "c.f", "residual",
                "total", "coarse", "assembly", "order", "symbolic", "numeric", "solve", "search", "ratio", "B/node", "growth");
    std::map<std::string, std::pair<int, double>> previous;
    for (const std::string& kind : shapes)
        for (const std::string& fabric : fabrics)
            for (const double n : sizes) {
                const EquilibriumProblem p = make_problem(kind, fabric == "woven", n, file);
                try {
                    const double direct = one_direct_solve(p);
                    const EquilibriumResult r = find_equilibrium(p);
                    const auto& t = r.times;
                    auto& before = previous[kind + fabric];
                    const double growth = before.first ? std::log(r.cpu_s / before.second) / std::log(double(r.vertices) / before.first) : 0;
                    before = {r.vertices, r.cpu_s};
                    std::printf("%-5.5s %-6s %7d %4d %4d %4d %4d %8.1e %8.3f %8.3f %8.3f %8.3f %8.3f %8.3f %8.3f %8.3f %7.2f %9.0f %6.2f\n", kind.c_str(),
                                fabric.c_str(), r.vertices, r.iterations, r.factorizations, r.coarse_iterations, r.coarse_factorizations, r.residual, r.cpu_s, t.coarse, t.assembly, t.ordering,
                                t.symbolic, t.numeric, t.solve, t.line_search, r.cpu_s / direct, r.peak_rss_mb * 1048576 / r.vertices, growth);
                } catch (const std::exception& e) {
                    std::printf("%-5.5s %-6s %7d failed: %s\n", kind.c_str(), fabric.c_str(), p.rest.n_nodes(), e.what());
                }
                std::fflush(stdout);
            }
    std::filesystem::remove(file);
}
