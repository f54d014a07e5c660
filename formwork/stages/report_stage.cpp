#include <algorithm>

#include "arcsim/base/files.hpp"
#include "arcsim/base/text.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/panels/sewing_order.hpp"
#include "formwork/report/report_pictures.hpp"
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
    if (has(summary, "panels")) {
        const PanelSet set = make_panels(*in.segmentation, scene.formwork.panels);   // with all measures
        in.panels = set.panels;
        in.sewing_order = report_steps(set, sewing_order(set, *in.segmentation, in.up));
    }
    if (has(summary, "sew")) {
        in.sewn = arcsim::read_obj(context.dir / "sew/sewn.obj").x;
        in.sewn_strain = read_strain(context.dir / "sew", in.segmentation->mesh.n_faces());
        in.convergence.push_back({"sew", residual_history(*summary.find("sew"))});
    }
    return in;
}

}  // namespace

JsonValue run_report(const StageContext& context) {
    const JsonValue summary = read_summary(context.dir);
    ReportInput in = gather(context, summary);
    context.progress.update({});
    in.pictures = draw_pictures(in);
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
