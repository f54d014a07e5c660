#include "arcsim/base/files.hpp"
#include "arcsim/base/text.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/equilibrium/equilibrium.hpp"
#include "formwork/load/cast_solid.hpp"
#include "formwork/mesher/mesh_file.hpp"
#include "formwork/stages/equilibrium_summary.hpp"
#include "formwork/stages/stage.hpp"
#include "formwork/stages/strain_file.hpp"

namespace formwork {

using arcsim::format_short;

namespace {

EquilibriumProblem make_problem(const StageContext& context, const BagMesh& mesh) {
    const FormworkParams& p = context.scene.formwork;
    EquilibriumProblem problem;
    problem.rest = mesh.surface;
    problem.flat = mesh.flat;
    problem.fixed = held_dofs(context.scene, mesh);
    problem.up = p.up;
    problem.plaster = context.scene.plaster();
    problem.pressure = p.inflate.pressure;
    problem.pressure_jacobian = p.inflate.pressure_jacobian;
    problem.material = p.inflate.material;
    problem.fabric_density = p.inflate.density;
    problem.self_weight = p.inflate.self_weight;
    problem.solver = p.inflate.solver;
    const double goal = p.inflate.solver.tolerance;
    problem.on_iteration = [&progress = context.progress, goal](const IterationReport& r) {
        progress.update({r.iteration, r.residual, goal, {}, r.phase + ", max stretch " + format_short(r.max_stretch)});
    };
    return problem;
}

/// The mesh of the file at the positions x, its rest coordinates as vt.
arcsim::ClothMesh deformed_mesh(const BagMesh& mesh, const EquilibriumProblem& problem, const std::vector<Vector3d>& x) {
    if (mesh.flat.empty()) return mesh_with_rest(x, problem.rest.faces, rest_in_own_planes(problem.rest));
    arcsim::ClothMesh m = mesh.cloth;
    m.x = m.ny = x;
    return m;
}

}  // namespace

arcsim::JsonValue run_inflate(const StageContext& context) {
    const BagMesh mesh = load_bag_mesh(context.scene);
    const EquilibriumProblem problem = make_problem(context, mesh);
    const std::filesystem::path folder = context.dir / "inflate";
    EquilibriumResult result;
    try {
        result = find_equilibrium(problem);
    } catch (const EquilibriumError& e) {
        if (e.last->x.empty()) throw;
        throw keep_unconverged("inflate", folder, e, deformed_mesh(mesh, problem, e.last->x));
    }
    for (const std::string& warning : result.warnings) context.progress.warning(warning);
    if (const std::string doubt = doubt_about_overflow(result, context.scene.plaster()); !doubt.empty())
        context.progress.warning("inflate: " + doubt);
    arcsim::write_obj(folder / "inflated.obj", deformed_mesh(mesh, problem, result.x));
    arcsim::write_obj(folder / "rest.obj", deformed_mesh(mesh, problem, mesh.surface.x));
    write_strain(folder, result.strain);
    if (result.volume_m3 > 0)
        write_stl(folder / "cast.stl", cast_solid({result.x, problem.rest.faces}, problem.up, result.fill_level_m, result.orientation), "cast");
    forget_unconverged(folder);
    context.progress.end("inflate: " + std::to_string(result.iterations) + " steps, residual " + format_short(result.residual, 2) + ", depth " +
                         format_short(result.depth_m) + " m, " + format_short(1000 * result.volume_m3) + " l, max stretch " +
                         format_short(result.max_stretch) + ", " + arcsim::format_duration(result.wall_s));
    return equilibrium_summary(result);
}

}  // namespace formwork
