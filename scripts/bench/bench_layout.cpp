/// Panels of one mesh: counts, stretch of the converged flat patterns, seam length, alignment, time.
///
///     bench_layout MESH.obj FIELD.txt [max_distortion [max_panels [min_width [DUMP.txt]]]] [--symmetry detect|off]
///                  [--subdivisions N] [--effort E]
///
/// Each subdivision makes four faces of one: for growth with size; E is segment.layout_effort. Prints one CSV line (with --header as the only argument: the header). DUMP.txt gets the cut mesh, panels
/// and seams for plotting.
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iostream>
#include <map>
#include <numbers>
#include <sstream>
#include <utility>

#include "arcsim/base/error.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/flatten/flatten.hpp"
#include "formwork/segment/panel_outline.hpp"
#include "formwork/segment/segment.hpp"
#include "scripts/bench/subdivide.hpp"

using namespace formwork;

namespace {

std::vector<DirectionData> read_field(const std::string& path) {
    std::ifstream in(path);
    std::vector<DirectionData> data;
    for (std::string line; std::getline(in, line);) {
        std::istringstream fields(line);
        DirectionData d;
        if (fields >> d.theta >> d.s1 >> d.s2) {
            if (!(fields >> d.weight)) d.weight = 1;
            data.push_back(d);
        }
    }
    return data;
}

/// Length-weighted mean angle between seams and the field's nearest arm, degrees.
double seam_drift_deg(const Segmentation& s) {
    double sum = 0, length = 0;
    std::map<std::pair<int, int>, int> left;
    for (int f = 0; f < s.mesh.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) left[{s.mesh.faces[f][k], s.mesh.faces[f][(k + 1) % 3]}] = f;
    for (const Seam& seam : s.seams) {
        if (seam.is_rim()) continue;
        for (std::size_t i = 0; i + 1 < seam.nodes.size(); ++i) {
            const int a = seam.nodes[i], b = seam.nodes[i + 1], f = left.at({a, b});
            const auto d = s.mesh.x[b] - s.mesh.x[a];
            const double angle = arcsim::face_frame(s.mesh, f).angle(d) - s.field_theta[f];
            sum += d.norm() * std::abs(std::remainder(angle, std::numbers::pi / 2)) * 180 / std::numbers::pi;
            length += d.norm();
        }
    }
    return length > 0 ? sum / length : 0;
}

}  // namespace

int main(int argc, char** argv) try {
    Symmetry symmetry = Symmetry::detect;
    int subdivisions = 0;
    double effort = 1;
    for (; argc > 2 && std::string(argv[argc - 2]).starts_with("--"); argc -= 2) {
        if (std::string(argv[argc - 2]) == "--symmetry") symmetry = std::string(argv[argc - 1]) == "off" ? Symmetry::off : Symmetry::detect;
        if (std::string(argv[argc - 2]) == "--subdivisions") subdivisions = std::stoi(argv[argc - 1]);
        if (std::string(argv[argc - 2]) == "--effort") effort = std::stod(argv[argc - 1]);
    }
    if (argc < 3) {
        std::cout << "mesh,faces,max_distortion,panels,disks,within_5,p95_worst,p95_area,seam_m,drift_deg,min_angle_deg,"
                     "violations,wall_s,cpu_s,field_cpu_s,peak_mb\n";
        return 0;
    }
    const arcsim::ClothMesh mesh = arcsim::read_obj(argv[1]);
    Surface s = mesh.surface();
    SegmentParams p;
    p.symmetry = symmetry;
    p.layout_effort = effort;
    if (argc > 3) p.max_distortion = std::stod(argv[3]);
    if (argc > 4) p.max_panels = std::stoi(argv[4]);
    if (argc > 5) p.min_width = std::stod(argv[5]);
    auto data = read_field(argv[2]);
    for (int i = 0; i < subdivisions; ++i) subdivide(s, data);
    auto cpu_s = [from = std::clock()]() mutable {
        const std::clock_t now = std::clock(), before = std::exchange(from, now);
        return static_cast<double>(now - before) / CLOCKS_PER_SEC;
    };
    smooth_cross_field(s, arcsim::build_topology(s), data, p.field);   // for its time alone: segment does it again
    const double field_cpu = cpu_s();
    const auto start = std::chrono::steady_clock::now();
    const Segmentation r = segment(s, data, p);
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double cpu = cpu_s();

    // Every panel laid flat, to convergence.
    int disks = 0;
    double area = 0, within = 0, worst = 0, mean95 = 0, smallest_angle = 180;
    CutMesh borders(r.mesh);
    double seam_length = 0;
    for (const Seam& seam : r.seams)
        for (std::size_t i = 0; i + 1 < seam.nodes.size(); ++i)
            if (!seam.is_rim()) {
                borders.mark_seam(seam.nodes[i], seam.nodes[i + 1]);
                seam_length += (r.mesh.x[seam.nodes[i]] - r.mesh.x[seam.nodes[i + 1]]).norm();
            }
    for (const auto& faces : panel_faces(r.panel, r.n_panels)) {
        const PanelPatch patch = extract_patch(borders, faces);
        const double a = patch.area();
        area += a;
        if (!patch.is_disk()) continue;
        ++disks;
        const StretchStatistics q = flatten_disk(patch.surface).stretch;
        within += a * q.within_5_percent;
        worst = std::max(worst, q.p95);
        mean95 += a * q.p95;
        std::cerr << "panel " << disks - 1 << ": faces " << faces.size() << " area " << a << " p95 " << q.p95
                  << " within " << q.within_5_percent << " corners " << corner_nodes(patch).size() << " width "
                  << patch_width(patch) << '\n';
    }
    for (int f = 0; f < r.mesh.n_faces(); ++f) smallest_angle = std::min(smallest_angle, arcsim::min_angle(r.mesh, f) * 180 / std::numbers::pi);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const std::string path = argv[1];
    std::cout << path.substr(path.find_last_of('/') + 1) << ',' << s.n_faces() << ',' << p.max_distortion << ',' << r.n_panels
              << ',' << disks << ',' << within / area << ',' << worst << ',' << mean95 / area << ',' << seam_length << ','
              << seam_drift_deg(r) << ',' << smallest_angle << ',' << r.violations.size() << ',' << wall << ',' << cpu << ',' << field_cpu << ','
              << static_cast<double>(usage.ru_maxrss) / 1024 << '\n';
    for (const std::string& v : r.violations) std::cerr << v << '\n';
    if (argc > 6) {
        std::ofstream out(argv[6]);
        for (const auto& x : r.mesh.x) out << "v " << x.transpose() << '\n';
        for (int f = 0; f < r.mesh.n_faces(); ++f)
            out << "f " << r.mesh.faces[f][0] << ' ' << r.mesh.faces[f][1] << ' ' << r.mesh.faces[f][2] << ' ' << r.panel[f] << '\n';
        for (const Seam& seam : r.seams) {
            out << "s " << seam.panel[0] << ' ' << seam.panel[1];
            for (int v : seam.nodes) out << ' ' << v;
            out << '\n';
        }
        for (const Singularity& q : r.singularities) out << "q " << q.node << ' ' << q.index4 << '\n';
    }
    return r.violations.empty() ? 0 : 3;
} catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return dynamic_cast<const arcsim::InputError*>(&e) ? 2 : 3;
}
