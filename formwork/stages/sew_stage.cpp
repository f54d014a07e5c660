#include "arcsim/base/text.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/load/cast_solid.hpp"
#include "formwork/mesher/mesh_file.hpp"
#include "formwork/sew/sew.hpp"
#include "formwork/stages/equilibrium_summary.hpp"
#include "formwork/stages/segmentation_file.hpp"
#include "formwork/stages/sew_data.hpp"
#include "formwork/stages/sew_files.hpp"
#include "formwork/stages/stage.hpp"
#include "formwork/stages/strain_file.hpp"

namespace formwork {

using arcsim::format_short;
using arcsim::JsonValue;

namespace {

std::optional<Surface> target_shape(const FormworkScene& scene) {
    const std::optional<arcsim::InputFile>& file = scene.formwork.sew->target;
    if (!file) return std::nullopt;
    Surface s = read_mesh_file(file->path).mesh.surface();
    for (Vector3d& x : s.x) x *= metres_per(scene.formwork.units);
    return s;
}

}  // namespace

JsonValue run_sew(const StageContext& context) {
    const FormworkScene& scene = context.scene;
    const SewParams& p = *scene.formwork.sew;
    const SewData data = read_sew_data(context);
    const Segmentation designed = read_segmentation(context.dir / "segment");
    const Segmentation s = as_cut(designed, context.dir / "panels");
    const PanelSet set = read_panels(context.dir / "panels" / "sewn_rest.obj", s);
    SewInput input = data.input(scene, s, set.panels);
    input.target = target_shape(scene);
    input.designed = &designed.mesh;
    const auto show = [&](const std::string& name, const IterationReport& step) {
        context.progress.update({step.iteration, step.residual, p.solver.tolerance, {},
                                 (name == "sew" ? "" : name + ", ") + step.phase + ", max stretch " + format_short(step.max_stretch)});
    };
    const std::filesystem::path folder = context.dir / "sew";
    SewResult r;
    try {
        r = sew_bag(input, p, show);
    } catch (const EquilibriumError& e) {
        if (e.last->x.empty()) throw;
        const SewnBag bag = make_sewn_bag(input, p);
        throw keep_unconverged("sew", folder, e, mesh_with_rest(e.last->x, bag.cut.faces, bag.flat));
    }
    forget_unconverged(folder);
    for (const std::string& warning : r.equilibrium.warnings) context.progress.warning(warning);
    if (const std::string doubt = doubt_about_overflow(r.equilibrium, context.scene.plaster()); !doubt.empty())
        context.progress.warning("sew: " + doubt);
    for (const GrainVariant& g : r.compare)
        if (!g.failure.empty()) context.progress.warning("sew/compare/" + g.name + ": " + g.failure);

    arcsim::write_obj(folder / "sewn.obj", mesh_with_rest(r.equilibrium.x, r.bag.cut.faces, r.bag.flat));
    write_strain(folder, r.equilibrium.strain);
    if (r.equilibrium.volume_m3 > 0)
        write_stl(folder / "cast.stl",
                  cast_solid({r.equilibrium.x, r.bag.cut.faces}, scene.formwork.up, r.equilibrium.fill_level_m, r.equilibrium.orientation), "cast");
    write_sew_tables(folder, r, s);
    JsonValue v = equilibrium_summary(r.equilibrium);
    add_sew_summary(r, v);
    std::string line = "sew: " + std::to_string(r.equilibrium.iterations) + " steps, residual " + format_short(r.equilibrium.residual, 2) +
                       ", mean shear " + format_short(r.weave.abs_shear.mean, 3);
    for (const GrainVariant& g : r.compare)
        if (g.failure.empty()) line += " (" + g.name + " " + format_short(g.mean_abs_shear, 3) + ")";
    context.progress.end(line + ", " + arcsim::format_duration(r.equilibrium.wall_s));
    return v;
}

}  // namespace formwork
