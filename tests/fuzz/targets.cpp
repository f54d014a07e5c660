#include "tests/fuzz/targets.hpp"

#include "arcsim/base/error.hpp"
#include "arcsim/base/params_writer.hpp"
#include "arcsim/material/material_data.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/mesher/mesh_file.hpp"
#include "formwork/scene/bag_mesh.hpp"
#include "formwork/scene/formwork_scene.hpp"
#include "formwork/scene/mesh_doctor.hpp"

namespace formwork {

namespace {

[[noreturn]] void broken(const char* promise) { throw std::logic_error(promise); }

/// What `formwork check` and the stages do with any mesh: the doctor must not fail, preparing it may refuse.
void use(MeshFile file) {
    for (const LengthUnit unit : {LengthUnit::m, LengthUnit::mm}) {
        examine_mesh(file, {unit}, arcsim::Vector3d::UnitZ());
        try {
            const BagMesh bag = prepare_bag_mesh(file, "fuzz", {unit});
            if (bag.surface.n_faces() != file.mesh.n_faces()) broken("a prepared mesh keeps its faces");
        } catch (const arcsim::InputError&) {
        }
    }
}

void read_obj(std::string_view bytes) {
    MeshFile file{arcsim::parse_obj(bytes, "fuzz.obj"), bytes.find("vt ") != std::string_view::npos};
    const ClothMesh again = arcsim::parse_obj(format_plain_obj(file.mesh, ""), "again.obj");
    if (again.face_nodes != file.mesh.face_nodes) broken("a written mesh reads back with its faces");
    use(std::move(file));
}
void read_ply(std::string_view bytes) { use({to_cloth_mesh(parse_ply(bytes, "fuzz.ply")), false}); }
void read_stl(std::string_view bytes) { use({to_cloth_mesh(parse_stl(bytes, "fuzz.stl")), false}); }

void read_any_json(std::string_view bytes) {
    const std::string once = arcsim::to_text(arcsim::parse_json(bytes, "fuzz.json").root);
    if (arcsim::to_text(arcsim::parse_json(once, "again.json").root) != once) broken("written JSON reads back as itself");
}
void read_scene_text(std::string_view bytes) {
    const FormworkScene scene = parse_scene(arcsim::parse_json(bytes, "conf/fuzz.json"), {{}, {}, true});   // beside the meshes that the corpus names
    effective_scene_text(scene, {});
}
void read_material_text(std::string_view bytes) { arcsim::parse_material(arcsim::parse_json(bytes, "fuzz.json")); }

}  // namespace

const std::vector<FuzzTarget>& fuzz_targets() {
    static const std::vector<FuzzTarget> targets{{"obj", read_obj},        {"ply", read_ply},          {"stl", read_stl},
                                                 {"json", read_any_json},  {"scene", read_scene_text}, {"material", read_material_text}};
    return targets;
}

}  // namespace formwork
