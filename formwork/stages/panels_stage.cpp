#include <chrono>

#include "arcsim/base/text.hpp"
#include "formwork/panels/pattern_files.hpp"
#include "formwork/sew/recut.hpp"
#include "formwork/stages/segmentation_file.hpp"
#include "formwork/stages/sew_data.hpp"
#include "formwork/stages/stage.hpp"
#include "formwork/stages/summary.hpp"

namespace formwork {

using arcsim::JsonValue;

namespace {

JsonValue summary_of(const PanelSet& set, const PatternFiles& files, double wall) {
    JsonValue v = JsonValue::object(), names = JsonValue::array();
    v.set("count", set.metrics.count);
    v.set("cloth_area_m2", set.metrics.cloth_area_m2);
    v.set("rest_area_m2", set.metrics.rest_area_m2);
    v.set("max_stretch_distortion", set.metrics.max_stretch_distortion);
    v.set("mean_stretch_distortion", set.metrics.mean_stretch_distortion);
    v.set("flips", set.metrics.flips);
    v.set("overlaps", set.metrics.overlaps);
    v.set("max_seam_length_mismatch", set.metrics.max_seam_length_mismatch);
    for (const std::string& file : files.names) names.add(file);
    v.set("files", std::move(names));
    v.set("roll_length_m", files.roll_length_m);
    v.set("roll_utilisation", files.utilisation);
    v.set("roll_utilisation_bound", files.utilisation_bound);
    v.set("wall_s", wall);
    return v;
}

}  // namespace

namespace {

/// Panels of the scene's layout, cut as often as it asks; the layout's nodes move to the shape that was cut last.
PanelSet cut_as_asked(const StageContext& context, Segmentation& s) {
    const FormworkParams& f = context.scene.formwork;
    const bool turns = f.panels.grain == GrainTarget::sewn;
    if (f.panels.recut == 0 && !turns) return make_panels(s, f.panels);
    if (!f.sew && turns)
        throw arcsim::InputError("/formwork/panels/grain: the grain is to follow the sewn bag, but the scene has no \"sew\" object. Add one, or set grain "
                                 "to \"inflated\".");
    if (!f.sew)
        throw arcsim::InputError("/formwork/panels/recut: the panels are cut again from the sewn bag, but the scene has no \"sew\" object. Add one, or set "
                                 "recut to 0.");
    const SewData data = read_sew_data(context);
    const auto show = [&](int round, const IterationReport& step) {
        context.progress.update({step.iteration, step.residual, f.sew->solver.tolerance, {}, "sewn bag " + std::to_string(round) + ", " + step.phase});
    };
    return recut_panels(s, f.panels, *f.sew, [&](const Segmentation& cut, const std::vector<FlatPanel>& panels) {
        return data.input(context.scene, cut, panels);
    }, show);
}

}  // namespace

JsonValue run_panels(const StageContext& context) {
    const auto start = std::chrono::steady_clock::now();
    Segmentation s = read_segmentation(context.dir / "segment");
    context.progress.update({});
    const FormworkScene& scene = context.scene;
    const PanelSet set = cut_as_asked(context, s);
    PatternInfo info;
    info.name = scene.name();
    info.up = scene.formwork.up;
    const JsonValue summary = read_summary(context.dir);
    if (const JsonValue* inflate = summary.find("inflate")) {   // for the bill of materials
        info.liquid_m3 = inflate->find("volume_m3")->number;
        info.liquid_kg = inflate->find("liquid_mass_kg")->number;
    }
    if (scene.formwork.sew) info.fabric_density = scene.formwork.sew->density;
    const PatternFiles files = write_patterns(set, s, make_pattern(set, s, info), context.dir / "panels");
    write_grain_directions(context.dir / "panels", s, scene.formwork.panels.grain == GrainTarget::inflated);
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    context.progress.end("panels: " + std::to_string(set.metrics.count) + " pieces, " + arcsim::format_short(set.metrics.cloth_area_m2) +
                         " m² of cloth, stretch distortion up to " + arcsim::format_short(100 * set.metrics.max_stretch_distortion, 2) +
                         " %, " + arcsim::format_duration(wall));
    return summary_of(set, files, wall);
}

}  // namespace formwork
