#include "tests/formwork/synthetic_report.hpp"

#include <cmath>

#include "formwork/report/report_pictures.hpp"
#include "tests/formwork/synthetic_bag.hpp"

using namespace formwork;

ReportInput synthetic_report(int around, int up) {
    const SyntheticBag bag = make_synthetic_bag(around, up);
    ReportInput in;
    in.title = "Twisted column, 300 mm";
    in.summary_json =
        R"({"inflate": {"converged": true, "residual": 3.1e-9, "iterations": 17, "vertices": 5953, "faces": 11808,
        "wall_s": 2.41, "volume_m3": 0.0024, "liquid_mass_kg": 4.1, "depth_m": 0.311, "max_stretch": 1.303,
        "support_force_N": [0, 0, 40.2], "wrinkled_faces": 120, "method": "static"},
        "segment": {"panels": 5, "singularities": {"+1/4": 4, "-1/4": 1}, "index_sum": 0.75, "seam_length_m": 1.52, "all_disks": true},
        "panels": {"count": 5, "cloth_area_m2": 0.094, "max_stretch_distortion": 0.05, "flips": 0, "files": ["panels.svg", "panels.dxf"]},
        "sew": {"converged": true, "volume_m3": 0.00231, "liquid_mass_kg": 3.93, "depth_m": 0.305, "mean_abs_shear": 0.004, "shape_rms_m": 0.0021,
        "compare": {"rotated_45": {"mean_abs_shear": 0.012, "max_abs_shear": 0.05, "shape_rms_m": 0.004}, "random": {"mean_abs_shear": 0.009, "max_abs_shear": 0.04, "shape_rms_m": 0.003}}}})";
    in.scene_json =
        R"({"cloths": [{"mesh": "meshes/column.obj"}], "formwork": {"inflate": {"material": {"model": "isotropic",
        "compression": "tension_field"}}, "sew": {"material": {"model": "tensor", "data": "materials/woven_table3.json"}}}})";
    in.rest = bag.segmentation.mesh;
    in.segmentation = bag.segmentation;
    for (Segmentation* g : {&*in.segmentation}) {  // the cut mesh of this bag is its input mesh
        for (int f = 0; f < g->mesh.n_faces(); ++f)
            for (int k = 0; k < 3; ++k) {
                SurfacePoint& p = g->source[g->mesh.faces[f][k]];
                p.face = f;
                p.barycentric = {0, 0, 0};
                p.barycentric[k] = 1;
            }
    }
    in.inflated = bag.inflated.x;
    in.inflated_strain = bag.strain;
    in.sewn = bag.sewn.x;
    in.sewn_strain = bag.sewn_strain;
    in.deviation = bag.deviation;
    in.deviation_from = "the surface that was cut";
    in.panels = bag.panels;
    in.sewing_order = {{"Panel 1 to panel 2, 302 mm, from the rim down", 3, {0, 1}},
                       {"Panel 2 to panel 3, 302 mm", 6, {1, 2}},
                       {"The bottom, panel 5, all around", 1, {0, 4}}};
    ConvergenceCurve a{"inflate", {}}, b{"sew", {}};
    for (int i = 0; i < 17; ++i)
        a.residual.push_back(std::pow(10, -0.03 * i * i) * (1 + 0.4 * std::sin(2.0 * i)));
    for (int i = 0; i < 11; ++i) b.residual.push_back(0.3 * std::pow(10, -0.08 * i * i));
    in.convergence = {a, b};
    in.notes = {"Made-up data: a trial of the report, not a simulation."};
    for (const Seam& seam : bag.segmentation.seams) {
        in.candidates.emplace_back();
        for (const int i : seam.nodes) in.candidates.back().push_back(bag.segmentation.mesh.x[i]);
    }
    if (around >= 64) in.pictures = draw_pictures(in);
    return in;
}
