#include <cmath>

#include "formwork/report/glb.hpp"
#include "formwork/report/pictures.hpp"
#include "formwork/report/report_pictures.hpp"
#include "formwork/report/surface_lines.hpp"
#include "formwork/report/vtu.hpp"

namespace formwork {
namespace {

Paint panel_paint(const Segmentation& g) {
    const std::vector<Rgb> colours = panel_colours(g);
    Paint paint;
    for (const int p : g.panel) paint.colour.push_back(colours[p]);
    return paint;
}

template <class Member>
Paint strain_paint(const StrainField& strain, Member member) {
    std::vector<double> v;
    for (const FaceStrain& s : strain) v.push_back(member(s));
    return paint_values(v, false, sequential_scale(v, "", ""));
}

}  // namespace

std::vector<std::string> write_viewer_files(const ReportInput& in,
                                            const std::filesystem::path& folder) {
    std::vector<std::string> names;
    const auto next = [&](const char* name) {
        names.push_back(name);
        return folder / name;
    };
    if (!in.inflated.empty() && !in.inflated_strain.empty()) {
        const Surface shown{in.inflated, in.rest.faces};
        write_vtu(next("inflate/inflated.vtu"), shown, {vector_array("rest", in.rest.x)},
                  strain_arrays(in.inflated_strain));
        write_glb(next("inflate/inflated.glb"), shown,
                  strain_paint(in.inflated_strain, [](const FaceStrain& s) { return s.lambda1; }),
                  {}, in.up, in.title + ", inflated, coloured by stretch");
    }
    if (!in.segmentation) return names;
    const Segmentation& g = *in.segmentation;
    write_glb(next("segment/panels.glb"), g.mesh, panel_paint(g), seam_lines(g, g.mesh), in.up,
              in.title + ", panels");
    if (!in.sewn.empty() && !in.sewn_strain.empty()) {
        const Surface shown{in.sewn, g.mesh.faces};
        std::vector<VtuArray> nodes{vector_array("cut_surface", g.mesh.x)},
            faces = strain_arrays(in.sewn_strain);
        faces.push_back(integer_array("panel", g.panel));
        if (!in.deviation.empty()) nodes.push_back({"deviation", 1, in.deviation});
        write_vtu(next("sew/sewn.vtu"), shown, nodes, faces);
        write_glb(
            next("sew/sewn.glb"), shown,
            strain_paint(in.sewn_strain, [](const FaceStrain& s) { return std::abs(s.eps_uv); }),
            seam_lines(g, shown), in.up, in.title + ", sewn, coloured by shear");
    }
    return names;
}

}  // namespace formwork
