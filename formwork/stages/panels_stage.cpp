#include <chrono>

#include "arcsim/base/files.hpp"
#include "arcsim/base/text.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/panels/panel_set.hpp"
#include "formwork/stages/csv.hpp"
#include "formwork/stages/segmentation_file.hpp"
#include "formwork/stages/stage.hpp"

namespace formwork {

using arcsim::JsonValue;

namespace {

/// The whole bag in ArcSim's dialect: nodes of the cut mesh, verts panel after panel, faces in the order of the cut mesh,
/// so that per-face results of the sewn bag fit the segmentation.
arcsim::ClothMesh sewn_rest(const Segmentation& s, const PanelSet& set) {
    arcsim::ClothMesh m;
    for (const auto& x : s.mesh.x) m.add_node(x);
    std::vector<Triangle> verts(s.mesh.faces.size());
    for (const FlatPanel& panel : set.panels) {
        const int first = m.n_verts();
        for (const auto& u : panel.u) m.add_vert(u);
        for (std::size_t k = 0; k < panel.face.size(); ++k)
            for (int c = 0; c < 3; ++c) verts[panel.face[k]][c] = first + panel.faces[k][c];
        m.groups.push_back(panel_name(panel.id));
    }
    for (int f = 0; f < s.mesh.n_faces(); ++f) m.add_face(s.mesh.faces[f], verts[f], s.panel[f]);
    return m;
}

JsonValue summary_of(const PanelSet& set, const std::vector<std::string>& files, double wall) {
    JsonValue v = JsonValue::object(), names = JsonValue::array();
    v.set("count", set.metrics.count);
    v.set("cloth_area_m2", set.metrics.cloth_area_m2);
    v.set("rest_area_m2", set.metrics.rest_area_m2);
    v.set("max_stretch_distortion", set.metrics.max_stretch_distortion);
    v.set("mean_stretch_distortion", set.metrics.mean_stretch_distortion);
    v.set("flips", set.metrics.flips);
    v.set("overlaps", set.metrics.overlaps);
    v.set("max_seam_length_mismatch", set.metrics.max_seam_length_mismatch);
    for (const std::string& file : files) names.add(file);
    v.set("files", std::move(names));
    v.set("wall_s", wall);
    return v;
}

}  // namespace

JsonValue run_panels(const StageContext& context) {
    const auto start = std::chrono::steady_clock::now();
    const Segmentation s = read_segmentation(context.dir / "segment");
    context.progress.update({});
    const PanelSet set = make_panels(s, context.scene.formwork.panels);
    const std::filesystem::path folder = context.dir / "panels";
    std::vector<std::string> files{"sewn_rest.obj"};
    arcsim::write_obj(folder / "sewn_rest.obj", sewn_rest(s, set));
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    context.progress.end("panels: " + std::to_string(set.metrics.count) + " pieces, " + arcsim::format_short(set.metrics.cloth_area_m2) +
                         " m² of cloth, stretch distortion up to " + arcsim::format_short(100 * set.metrics.max_stretch_distortion, 2) +
                         " %, " + arcsim::format_duration(wall));
    return summary_of(set, files, wall);
}

}  // namespace formwork
