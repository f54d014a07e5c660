/// Flat panels of one mesh: distortion before and after the seams are made equal, mismatch, nesting, time.
///
///     bench_panels MESH.obj FIELD.txt [size_m [max_distortion [max_panels [OUT_DIR]]]]
///
/// FIELD.txt: one line per face, `theta s1 s2 [weight]`. The mesh is scaled so that the longest side of its
/// box is size_m. Prints one CSV line (without arguments: the header); OUT_DIR gets the pattern files.
#include <chrono>
#include <filesystem>
#include <iostream>

#include "arcsim/mesh/obj_io.hpp"
#include "formwork/flatten/flatten.hpp"
#include "formwork/panels/cut_panels.hpp"
#include "formwork/panels/pattern_files.hpp"
#include "formwork/stages/segmentation_file.hpp"
#include "formwork/segment/direction_data.hpp"
#include "formwork/segment/segment.hpp"

using namespace formwork;

namespace {

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Every panel laid flat on its own: what the distortion and the seams would be without the joint solve.
struct Alone {
    double mean = 0, symmetric_dirichlet = 0, within_5 = 0, mismatch = 0;
};
Alone flatten_alone(const Segmentation& s, PanelSet set) {
    Alone result;
    double area = 0;
    for (FlatPanel& panel : set.panels) {
        const FlattenResult flat = flatten_disk(panel_surface(s, panel));
        panel.u = flat.u;
        area += panel.rest_area;
        result.mean += panel.rest_area * flat.stretch.mean;
        result.symmetric_dirichlet += panel.rest_area * flat.stretch.symmetric_dirichlet;
        result.within_5 += panel.rest_area * flat.stretch.within_5_percent;
    }
    for (double* v : {&result.mean, &result.symmetric_dirichlet, &result.within_5}) *v /= area;
    for (const PanelSeam& seam : set.seams) {
        if (seam.is_rim()) continue;
        std::array<double, 2> length{0, 0};
        for (int side : {0, 1}) {
            const std::vector<Vector2d> chain = flat_chain(set, seam.side[side]);
            for (std::size_t k = 0; k + 1 < chain.size(); ++k) length[side] += (chain[k + 1] - chain[k]).norm();
        }
        result.mismatch = std::max(result.mismatch, std::abs(length[0] - length[1]) / std::max(length[0], length[1]));
    }
    return result;
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc == 2) {   // a folder of `formwork run`: its panels each laid flat alone
        const Segmentation s = read_segmentation(std::filesystem::path(argv[1]) / "segment");
        PanelParams panel_params;
        panel_params.max_seam_mismatch = panel_params.max_distortion = 1;
        const Alone alone = flatten_alone(s, make_panels(s, panel_params));
        std::cout << "folder,alone_symD,alone_mean,alone_mismatch\n"
                  << argv[1] << ',' << alone.symmetric_dirichlet << ',' << alone.mean << ',' << alone.mismatch << '\n';
        return 0;
    }
    if (argc < 3) {
        std::cout << "mesh,faces,panels,seam_m,alone_mean,alone_symD,alone_within5,alone_mismatch,mean,symD,within5,p95_worst,max,mismatch,"
                     "flips,overlaps,grain_deg,utilisation,segment_s,panels_s,pattern_s\n";
        return 0;
    }
    Surface surface = arcsim::read_obj(argv[1]).surface();
    Vector3d low = surface.x.front(), high = low;
    for (const Vector3d& x : surface.x) low = low.cwiseMin(x), high = high.cwiseMax(x);
    const double scale = (argc > 3 ? std::stod(argv[3]) : 1.0) / (high - low).maxCoeff();
    for (Vector3d& x : surface.x) x *= scale;
    SegmentParams segment_params;
    if (argc > 4) segment_params.max_distortion = std::stod(argv[4]);
    if (argc > 5) segment_params.max_panels = std::stoi(argv[5]);
    const auto data = read_field_file(argv[2], arcsim::build_topology(surface), {});

    const double t0 = seconds();
    const Segmentation s = segment(surface, data, segment_params);
    const double t1 = seconds();
    PanelParams panel_params;   // the table shows what the limits would refuse
    panel_params.max_seam_mismatch = panel_params.max_distortion = 1;
    const PanelSet set = make_panels(s, panel_params);
    const double t2 = seconds();
    PatternInfo info;
    info.name = std::filesystem::path(argv[1]).stem().string();
    const Pattern pattern = make_pattern(set, s, info);
    const double t3 = seconds();
    if (argc > 6) write_patterns(set, s, pattern, argv[6]);

    const Alone alone = flatten_alone(s, set);
    double seam_length = 0, symmetric_dirichlet = 0, within = 0, p95 = 0, grain = 0, weight = 0;
    for (const PanelSeam& seam : set.seams) seam_length += seam.is_rim() ? 0 : seam.rest_length;
    for (const FlatPanel& p : set.panels) {
        const StretchStatistics flat = measure_stretch(p.faces, rest_shapes(panel_surface(s, p)), p.u);
        symmetric_dirichlet += p.rest_area * flat.symmetric_dirichlet;
        within += p.rest_area * flat.within_5_percent;
        grain += p.rest_area * p.grain_deviation_deg;
        weight += p.rest_area;
        p95 = std::max(p95, flat.p95);
    }
    std::cout << info.name << ',' << surface.n_faces() << ',' << set.metrics.count << ',' << seam_length << ',' << alone.mean << ','
              << alone.symmetric_dirichlet << ',' << alone.within_5 << ',' << alone.mismatch << ',' << set.metrics.mean_stretch_distortion << ','
              << symmetric_dirichlet / weight << ',' << within / weight << ',' << p95 << ',' << set.metrics.max_stretch_distortion << ','
              << set.metrics.max_seam_length_mismatch << ',' << set.metrics.flips << ',' << set.metrics.overlaps << ',' << grain / weight << ','
              << pattern.nest.utilisation << ',' << t1 - t0 << ',' << t2 - t1 << ',' << t3 - t2 << '\n';
    return 0;
} catch (const std::exception& e) {
    std::cerr << (argc > 1 ? argv[1] : "") << ": " << e.what() << '\n';
    return 1;
}
