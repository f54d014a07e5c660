#include "arcsim/base/text.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/equilibrium/equilibrium.hpp"
#include "formwork/stages/equilibrium_summary.hpp"
#include "formwork/stages/segmentation_file.hpp"
#include "formwork/stages/stage.hpp"
#include "formwork/stages/strain_file.hpp"

namespace formwork {

using arcsim::format_short;
using arcsim::JsonValue;

namespace {

/// Rest coordinates per face of the cut mesh: the flat panels, u along the warp.
std::vector<FlatTriangle> flat_of_panels(const Segmentation& s, const PanelSet& set) {
    std::vector<FlatTriangle> flat(s.mesh.faces.size());
    for (const FlatPanel& panel : set.panels)
        for (std::size_t k = 0; k < panel.face.size(); ++k)
            for (int c = 0; c < 3; ++c) flat[panel.face[k]][c] = panel.u[panel.faces[k][c]];
    return flat;
}

/// Springs of (10) along every edge of every sewn seam; L is the edge's length on the surface that was cut.
std::vector<SeamSpring> seam_springs(const Segmentation& s, const SewParams& p) {
    std::vector<SeamSpring> springs;
    for (const Seam& seam : s.seams)
        for (std::size_t i = 0; !seam.is_rim() && i + 1 < seam.nodes.size(); ++i) {
            const int a = seam.nodes[i], b = seam.nodes[i + 1];
            const double L = (s.mesh.x[b] - s.mesh.x[a]).norm();
            springs.push_back({a, b, L, p.seam_EA ? *p.seam_EA / L : p.seam_stiffness});
        }
    return springs;
}

/// A node of the cut mesh is held along an axis when it lies on held nodes only.
std::vector<char> held_on_cut_mesh(const std::vector<char>& held, const std::vector<Triangle>& faces, const Segmentation& s) {
    std::vector<char> out(3 * s.source.size(), 0);
    for (std::size_t i = 0; i < s.source.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
            bool all = true;
            for (int k = 0; k < 3; ++k)
                all = all && (s.source[i].barycentric[k] < 1e-9 || held[3 * faces[s.source[i].face][k] + axis]);
            out[3 * i + axis] = all;
        }
    return out;
}

/// Area-weighted mean and largest |eps_uv| in the weave frame.
void add_shear(const EquilibriumResult& r, const Segmentation& s, JsonValue& v) {
    double sum = 0, area = 0, largest = 0, tension = 0;
    for (int f = 0; f < s.mesh.n_faces(); ++f) {
        const double a = arcsim::face_area(s.mesh, f), shear = std::abs(r.strain[f].eps_uv);
        sum += a * shear, area += a;
        largest = std::max(largest, shear);
        tension = std::max(tension, r.strain[f].tension1);
    }
    v.set("mean_abs_shear", sum / area);
    v.set("max_abs_shear", largest);
    v.set("max_tension_N_per_m", tension);
}

}  // namespace

JsonValue run_sew(const StageContext& context) {
    const FormworkScene& scene = context.scene;
    const BagMesh mesh = load_bag_mesh(scene);
    const Segmentation s = read_segmentation(context.dir / "segment");
    const PanelSet set = read_panels(context.dir / "panels" / "sewn_rest.obj", s);
    const SewParams& p = *scene.formwork.sew;

    EquilibriumProblem problem;
    problem.rest = s.mesh;
    problem.flat = flat_of_panels(s, set);
    problem.fixed = held_on_cut_mesh(held_dofs(scene, mesh), mesh.surface.faces, s);
    problem.up = scene.formwork.up;
    problem.plaster = scene.plaster();
    problem.material = p.material;
    problem.fabric_density = p.density;
    problem.seams = seam_springs(s, p);
    problem.solver = p.solver;
    problem.on_iteration = [&](const IterationReport& r) {
        context.progress.update({r.iteration, r.residual, p.solver.tolerance, {}, r.phase + ", max stretch " + format_short(r.max_stretch)});
    };
    const EquilibriumResult result = find_equilibrium(problem);
    for (const std::string& warning : result.warnings) context.progress.warning(warning);

    const std::filesystem::path folder = context.dir / "sew";
    arcsim::write_obj(folder / "sewn.obj", mesh_with_rest(result.x, s.mesh.faces, problem.flat));
    write_strain(folder, result.strain);
    JsonValue v = equilibrium_summary(result);
    add_shear(result, s, v);
    context.progress.end("sew: " + std::to_string(result.iterations) + " steps, residual " + format_short(result.residual, 2) + ", mean shear " +
                         format_short(v.find("mean_abs_shear")->number, 3) + ", " + arcsim::format_duration(result.wall_s));
    return v;
}

}  // namespace formwork
