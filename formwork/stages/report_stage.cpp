#include <algorithm>
#include <cmath>

#include "arcsim/base/files.hpp"
#include "arcsim/base/text.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/panels/sewing_order.hpp"
#include "formwork/report/report_pictures.hpp"
#include "formwork/stages/csv.hpp"
#include "formwork/stages/segmentation_file.hpp"
#include "formwork/stages/stage.hpp"
#include "formwork/stages/strain_file.hpp"
#include "formwork/stages/summary.hpp"

namespace formwork {

using arcsim::JsonValue;
namespace fs = std::filesystem;

namespace {

bool has(const JsonValue& summary, std::string_view stage) { return summary.find(stage) != nullptr; }

std::vector<double> residual_history(const JsonValue& stage) {
    std::vector<double> history;
    if (const JsonValue* v = stage.find("residual_history"))
        for (const JsonValue& item : v->items) history.push_back(item.number);
    return history;
}

/// Deviation and seam forces. A given target is what the user wants to see the distance from.
void read_sewn_measures(const fs::path& folder, ReportInput& in) {
    const Surface& mesh = in.segmentation->mesh;
    const CsvFile deviation(folder / "deviation.csv", {"vertex", "from_cut_m", "from_inflated_m"});
    const bool has_target = deviation.n_columns() > 3;
    in.deviation_from = has_target ? "the target" : "the surface that was cut";
    for (int i = 0; i < deviation.n_rows(); ++i) in.deviation.push_back(deviation.number(i, has_target ? 3 : 1));
    // Further nodes are second sides of stitched seams, which gap by less than a picture shows.
    in.deviation.resize(mesh.x.size());
    in.sewn.resize(mesh.x.size());
    const CsvFile edges(folder / "seam_edges.csv", {"seam", "vertex_a", "vertex_b", "length_m", "thread_force_N"});
    for (int i = 0; i < edges.n_rows(); ++i)
        in.seam_forces.push_back({{edges.integer(i, 1, 0, mesh.n_nodes()), edges.integer(i, 2, 0, mesh.n_nodes())}, edges.number(i, 4)});
}

/// Where the seams are pressed together, and what the model makes of it: SewParams departs from (10) there.
std::string seam_note(const JsonValue& sew, const SewParams& params) {
    const JsonValue *edges = sew.find("seam_edges"), *shorter = sew.find("seam_edges_shorter");
    if (!edges || !shorter) return "Seams: run the stage sew again for their state.";
    return "Seams: " + std::to_string(std::lround(shorter->number)) + " of " + std::to_string(std::lround(edges->number)) +
           " edges are shorter than at rest; there the thread " +
           (params.thread_compression == ThreadCompression::slack ? "is slack (sew.thread_compression: slack)."
                                                                  : "pushes, as equation 10 reads (sew.thread_compression: full).");
}

/// Everything that the stages left in the folder.
ReportInput gather(const StageContext& context, const JsonValue& summary) {
    const FormworkScene& scene = context.scene;
    ReportInput in;
    in.title = scene.formwork.report.title.empty() ? scene.name() : scene.formwork.report.title;
    in.scene_json = effective_scene_text(scene, context.dir);
    in.summary_json = arcsim::to_text(summary);
    in.up = scene.formwork.up;
    in.notes = scene.warnings;
    const BagMesh mesh = load_bag_mesh(scene);
    in.notes.insert(in.notes.end(), mesh.notes.begin(), mesh.notes.end());
    in.rest = mesh.surface;
    if (has(summary, "inflate")) {
        in.inflated = arcsim::read_obj(context.dir / "inflate/inflated.obj").x;
        in.inflated_strain = read_strain(context.dir / "inflate", in.rest.n_faces());
        in.convergence.push_back({"inflate", residual_history(*summary.find("inflate"))});
    }
    if (has(summary, "segment")) in.segmentation = read_segmentation(context.dir / "segment");
    if (in.segmentation)
        for (const CandidateCurve& c : in.segmentation->candidates) in.candidates.push_back(c.points);
    if (has(summary, "panels")) {
        const Segmentation cut = as_cut(*in.segmentation, context.dir / "panels");
        const PanelSet set = read_panels(context.dir / "panels/sewn_rest.obj", cut);
        in.panels = set.panels;
        in.sewing_order = report_steps(set, sewing_order(set, cut, in.up));
    }
    if (has(summary, "sew")) {
        in.sewn = arcsim::read_obj(context.dir / "sew/sewn.obj").x;
        in.sewn_strain = read_strain(context.dir / "sew", in.segmentation->mesh.n_faces());
        in.convergence.push_back({"sew", residual_history(*summary.find("sew"))});
        read_sewn_measures(context.dir / "sew", in);
        in.notes.push_back(seam_note(*summary.find("sew"), *scene.formwork.sew));
    }
    return in;
}

}  // namespace

JsonValue run_report(const StageContext& context) {
    const JsonValue summary = read_summary(context.dir);
    ReportInput in = gather(context, summary);
    context.progress.update({});
    in.pictures = draw_pictures(in);
    const fs::path angles = context.dir / "sew/weave_angle.png";
    if (has(summary, "sew") && fs::exists(angles))
        in.pictures.push_back({"sewn_weave_angle", "Sewn bag: angle of the weave",
                               "How much of the cloth has warp and weft off square, and by how much.", arcsim::read_text_file(angles)});
    JsonValue names = JsonValue::array();
    for (const ReportPicture& picture : in.pictures) {
        const std::string name = "pictures/" + picture.name + ".png";
        arcsim::write_file_atomically(context.dir / name, picture.png);
        names.add(name);
    }
    for (const std::string& name : write_viewer_files(in, context.dir)) names.add(name);
    const fs::path file = context.dir / "report.html";
    write_report(in, file);
    context.progress.end("report: " + file.string());
    JsonValue v = JsonValue::object();
    v.set("file", "report.html");
    v.set("files", std::move(names));
    return v;
}

}  // namespace formwork
