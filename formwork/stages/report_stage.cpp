#include <algorithm>

#include "arcsim/base/files.hpp"
#include "arcsim/base/text.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/report/pictures.hpp"
#include "formwork/report/report.hpp"
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
    if (has(summary, "panels")) in.panels = read_panels(context.dir / "panels/sewn_rest.obj", *in.segmentation).panels;
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
    const auto picture = [&](const std::string& name, const Image& image, const std::string& title, const std::string& caption) {
        const std::string png = encode_png(image);
        arcsim::write_file_atomically(context.dir / "pictures" / (name + ".png"), png);
        in.pictures.push_back({name, title, caption, png});
    };
    if (!in.inflated.empty()) {
        const Surface filled{in.inflated, in.rest.faces};
        picture("inflated", picture_stretch(filled, in.inflated_strain, in.up, "Filled bag: largest stretch"), "Filled bag", "Largest principal stretch of the isotropic fabric.");
    }
    if (in.segmentation) picture("panels_on_bag", picture_panels(*in.segmentation, in.segmentation->mesh, in.up, "Panels"), "Panels on the bag", "Seams follow the strain.");
    if (!in.panels.empty()) picture("panels_flat", picture_flat_panels(*in.segmentation, in.panels, "Flat panels"), "Flat panels", "Warp upwards, one common scale.");
    if (!in.sewn.empty()) {
        const Surface sewn{in.sewn, in.segmentation->mesh.faces};
        picture("sewn_shear", picture_shear(sewn, in.sewn_strain, in.up, "Sewn bag: shear"), "Sewn bag", "Shear of the weave, |eps_uv|.");
    }
    const fs::path file = context.dir / "report.html";
    write_report(in, file);
    context.progress.end("report: " + file.string());
    JsonValue v = JsonValue::object();
    v.set("file", "report.html");
    return v;
}

}  // namespace formwork
