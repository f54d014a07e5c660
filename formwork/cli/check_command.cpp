#include <algorithm>
#include <cstdio>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/cli/session.hpp"
#include "formwork/scene/doubts.hpp"
#include "formwork/scene/formwork_scene.hpp"
#include "formwork/scene/mesh_doctor.hpp"
#include "formwork/stages/cost_estimate.hpp"

namespace formwork {

namespace {

void print(const char* mark, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) std::printf("%s%s\n", mark, line.c_str());
}

std::string fabric(const MaterialParams& m) {
    return std::string(m.model == FabricModel::isotropic ? "isotropic fabric" : "woven fabric of " + m.data.name) +
           (m.compression == Compression::tension_field ? ", wrinkles carry tension only" : ", compression resisted");
}

std::string method(const SolverParams& s) {
    return std::string(arcsim::name_of(solver_method_names, s.method)) + ", residual " + arcsim::format_short(s.tolerance, 2) +
           (s.accuracy ? " (accuracy " + arcsim::format_short(*s.accuracy, 2) + ")" : "");
}

/// What the scene will have modelled and what not, in words, and what that is likely to cost.
std::vector<std::string> modelled(const FormworkScene& scene, int vertices) {
    const FormworkParams& p = scene.formwork;
    std::vector<std::string> lines, absent{"bending", "friction", "contact of the bag with itself or a frame", "setting of the plaster"};
    if (p.plaster) {
        const bool liquid = p.plaster->density > 0, in_time = p.inflate.solver.method == SolverMethod::backward_euler ||
                                                              p.inflate.solver.method == SolverMethod::newton_euler ||
                                                              p.inflate.solver.method == SolverMethod::bdf2;
        lines.push_back("inflate: membrane equilibrium, " + fabric(p.inflate.material) + (liquid ? ", liquid" : "") +
                        (p.plaster->overpressure != 0 ? ", overpressure" : "") + (p.inflate.self_weight ? ", own weight" : "") +
                        (in_time ? ", inertia" : "") + "; " + method(p.inflate.solver));
        lines.push_back("inflate: likely " + words(estimate_equilibrium(vertices, p.inflate.solver, p.inflate.material)));
        if (!liquid) absent.push_back("liquid");
        if (p.plaster->overpressure == 0) absent.push_back("overpressure");
        if (!p.inflate.self_weight) absent.push_back("the fabric's own weight");
        if (!in_time) absent.push_back("inertia");
    }
    if (p.sew) {
        lines.push_back("sew: " + fabric(p.sew->material) + ", seams as threads; " + method(p.sew->solver));
        lines.push_back("sew: likely " + words(estimate_equilibrium(vertices, p.sew->solver, p.sew->material)) + " for each grain compared");
    } else {
        absent.push_back("seams and weave: the scene has no \"sew\" object");
    }
    std::string left_out;
    for (const std::string& a : absent) left_out += (left_out.empty() ? "" : ", ") + a;
    lines.push_back("not modelled, and not computed: " + left_out);
    return lines;
}

void check(const SceneArguments& arguments, const std::string& places_file, Session& session) {
    const FormworkScene scene = read_scene(arguments.scene, {arguments.overrides, arguments.threads, arguments.ignore_unsupported});
    const FormworkParams& p = scene.formwork;
    const std::string mesh_name = scene.mesh_file().path.string();
    const MeshDiagnosis mesh = examine_mesh(read_mesh_file(scene.mesh_file().path), {p.units, p.rest, p.weld, p.any_size}, p.up);
    if (!session.quiet) {
        std::printf("%s\n", effective_scene_text(scene, std::filesystem::path(arguments.scene).parent_path()).c_str());
        std::printf("%s\n", mesh_name.c_str());
        print("  ", mesh.facts);
    }
    print("warning: ", scene.warnings);
    print(("warning: " + mesh_name + ": ").c_str(), mesh.warnings);
    print(("error: " + mesh_name + ": ").c_str(), mesh.faults);
    if (!places_file.empty() && !mesh.places_obj.empty()) {
        arcsim::write_file_atomically(places_file, mesh.places_obj);
        std::printf("faulty places: %s\n", places_file.c_str());
    }
    // What only the stages' own loading finds: sizes, areas, rest coordinates, selectors that hold nothing.
    const BagMesh bag = load_bag_mesh(scene);
    std::vector<std::string> news;
    for (const std::string& note : bag.notes)
        if (std::find(mesh.warnings.begin(), mesh.warnings.end(), note) == mesh.warnings.end()) news.push_back(note);
    print(("note: " + mesh_name + ": ").c_str(), news);
    if (!session.quiet) print("  ", modelled(scene, bag.surface.n_nodes()));
    if (scene.has_formwork && !p.segment.field) {
        const std::vector<char> held = held_dofs(scene, bag);
        for (const std::string& doubt : doubts_about_plaster(scene.plaster(), bag.surface, held, p.up))
            std::printf("warning: %s: %s\n", arguments.scene.c_str(), doubt.c_str());
        const auto n = std::count(held.begin(), held.end(), 1);
        if (!session.quiet) std::printf("  %zu degrees of freedom, %ld held\n", held.size(), static_cast<long>(n));
    }
    if (!session.quiet) std::printf("%s: ok\n", arguments.scene.c_str());
}

}  // namespace

void add_check_command(CLI::App& app, Session& session) {
    CLI::App* command = add_command(app, session, "check", "Print the effective scene and examine its mesh; compute nothing",
                                    "  formwork check conf/column.json                      every key with its value; mesh facts in mm\n"
                                    "  formwork check mine.json --places faults.obj         flipped and non-manifold places as an OBJ");
    auto arguments = std::make_shared<SceneArguments>();
    auto places = std::make_shared<std::string>();
    add_scene_arguments(command, *arguments, false);
    command->add_option("--places", *places, "OBJ file for the faulty places of the mesh, if there are any")->type_name("FILE");
    command->callback([arguments, places, &session] { check(*arguments, *places, session); });
}

}  // namespace formwork
