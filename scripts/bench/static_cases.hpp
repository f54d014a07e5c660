#pragma once

#include <unistd.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "formwork/equilibrium/static_system.hpp"
#include "formwork/mesher/mesh_kinds.hpp"

/// The bags on which the equilibrium solver is timed: disk, sock and column stretch only; square, pillow and teabag
/// wrinkle. Fabrics: soft (isotropic table 2) and woven (constant stiffness).
namespace static_cases {

using namespace formwork;

inline bool on_border(const Vector3d& x) { return x[0] < 1e-9 || x[1] < 1e-9 || x[0] > 0.3 - 1e-9 || x[1] > 0.3 - 1e-9; }

/// Two flat sheets sewn along their edges, hung by one of them, its upper edge at z = 0; opened by 2 mm, so that they
/// have two sides.
inline Surface make_hung_pillow(double edge) {
    const Surface sheet = make_strip({.length = 0.3, .width = 0.3, .edge = edge});
    Surface s = sheet;
    std::vector<int> twin(sheet.x.size());
    for (std::size_t i = 0; i < sheet.x.size(); ++i) {
        const bool border = on_border(sheet.x[i]);
        twin[i] = border ? static_cast<int>(i) : static_cast<int>(s.x.size());
        if (border) continue;
        const double bulge = 1e-3 * std::sin(M_PI * sheet.x[i][0] / 0.3) * std::sin(M_PI * sheet.x[i][1] / 0.3);
        s.x.push_back(sheet.x[i] - Vector3d(0, 0, bulge));
        s.x[i][2] = bulge;
    }
    for (const auto& t : sheet.faces) s.faces.push_back({twin[t[0]], twin[t[2]], twin[t[1]]});
    for (auto& x : s.x) x = Vector3d(x[0], x[2], x[1] - 0.3);
    for (auto& t : s.faces) std::swap(t[1], t[2]);
    return s;
}

inline Surface make_mesh(const std::string& kind, double nodes) {
    const double triangle = std::sqrt(3.) / 2;   // area per node of an equilateral mesh, edge 1
    const auto edge = [&](double area) { return std::sqrt(area / nodes / triangle); };
    if (kind == "disk") return make_disk({.radius = 0.15, .edge = edge(M_PI * 0.15 * 0.15)});
    if (kind == "sock") return make_sock({.radius = 0.1, .height = 0.4, .edge = edge(M_PI * 0.1 * 0.9)});
    if (kind == "square" || kind == "teabag") return make_strip({.length = 0.3, .width = 0.3, .edge = edge(0.09)});
    if (kind == "pillow") return make_hung_pillow(edge(0.18));
    ColumnSize size;
    size.edge = edge(0.11);
    return make_column(size);
}

/// A material file that goes with its owner.
class WovenFile {
public:
    WovenFile() : path_(std::filesystem::temp_directory_path() / ("bench_static_woven_" + std::to_string(getpid()) + ".json")) {
        std::ofstream out(path_);
        out << R"({"density": 0.2, "bending": [[0,0,0,0,0],[0,0,0,0,0],[0,0,0,0,0]], "stretching": [)";
        for (int i = 0; i < 6; ++i) out << (i ? "," : "") << "[450000, 25, 500000, 10800]";
        out << "]}";
    }
    ~WovenFile() { std::filesystem::remove(path_); }
    WovenFile(const WovenFile&) = delete;
    WovenFile& operator=(const WovenFile&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

inline int nearest(const Surface& s, const Vector3d& at) {
    int best = 0;
    for (int i = 0; i < s.n_nodes(); ++i)
        if ((s.x[i] - at).norm() < (s.x[best] - at).norm()) best = i;
    return best;
}

/// One weave frame around the bag: v as near to the vertical as each face allows.
inline std::vector<FlatTriangle> weave_frames(const Surface& s) {
    std::vector<FlatTriangle> flat;
    for (const auto& t : s.faces) {
        const Vector3d n = (s.x[t[1]] - s.x[t[0]]).cross(s.x[t[2]] - s.x[t[0]]).normalized();
        Vector3d v = Vector3d(0, 0, 1) - n[2] * n;
        if (v.norm() < 0.3) v = Vector3d(0, 1, 0) - n[1] * n;
        v.normalize();
        const Vector3d u = v.cross(n);
        flat.emplace_back();
        for (int k = 0; k < 3; ++k) flat.back()[k] = {s.x[t[k]].dot(u), s.x[t[k]].dot(v)};
    }
    return flat;
}

inline EquilibriumProblem make_problem(const std::string& kind, bool woven, double nodes, const WovenFile& file) {
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
        if (kind == "teabag")   // the mirror half: its border moves in its own plane, two nodes keep it in place
            for (int c = 0; c < 3; ++c) p.fixed[3 * i + c] = c == 2 && on_border(p.rest.x[i]);
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
        p.material.data = {"woven", file.path()};
        p.material.stretching_mult = 0.5;
        p.flat = weave_frames(p.rest);
    }
    return p;
}

/// "square:soft sock:woven 10000 40000" on a command line, in any order.
struct NamedCases {
    std::vector<std::string> bags;   // KIND:FABRIC
    std::vector<double> nodes;
};

/// What the arguments name; where they name no bag, or no size, the given ones.
inline NamedCases named_cases(int argc, char** argv, std::vector<std::string> bags, std::vector<double> nodes) {
    NamedCases named;
    for (int i = 1; i < argc; ++i)
        if (std::isdigit(static_cast<unsigned char>(argv[i][0]))) named.nodes.push_back(std::stod(argv[i]));
        else named.bags.emplace_back(argv[i]);
    if (named.bags.empty()) named.bags = std::move(bags);
    if (named.nodes.empty()) named.nodes = std::move(nodes);
    return named;
}

}  // namespace static_cases
