#include "formwork/scene/formwork_scene.hpp"

#include <sstream>

#include "arcsim/base/error.hpp"
#include "arcsim/base/params_schema.hpp"
#include "arcsim/base/params_writer.hpp"
#include "arcsim/base/text.hpp"

namespace formwork {

using arcsim::InputError;
using arcsim::JsonKind;
using arcsim::JsonValue;

void visit(arcsim::Archive& a, FormworkScene& s) {
    a.ignored("$schema", "it is for editors.");
    a.ignored("expect", "it is for the tests.");
    visit(a, s.root);
    a.nested("formwork", s.formwork, "What this program does beyond a cloth simulation.");
}

const arcsim::InputFile& FormworkScene::mesh_file() const {
    if (root.cloths.empty())
        throw InputError(source + ": /cloths: names no mesh; this scene is for the commands tensile and fit. Add \"cloths\": [{\"mesh\": \"bag.obj\"}].");
    return root.cloths.front().mesh;
}

const PlasterParams& FormworkScene::plaster() const {
    if (!formwork.plaster)
        throw InputError(source + ": /formwork/plaster is missing: this stage fills the bag. Add \"plaster\": {\"density\": 1500, \"fill\": {\"depth_below_rim\": 0}}.");
    return *formwork.plaster;
}

namespace {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
    return parts;
}

void apply_override(JsonValue& root, const std::string& override) {
    const std::size_t equals = override.find('=');
    const std::string origin = "--set " + override;
    if (equals == std::string::npos || equals == 0)
        throw InputError(origin + ": expected KEY=VALUE, for example --set inflate.solver.tolerance=1e-6.");
    const std::string key = override.substr(0, equals), value = override.substr(equals + 1);
    std::vector<std::string> path;
    if (key.front() == '/') {
        path = split(key.substr(1), '/');   // from the root; dots separate too
        if (path.size() == 1) path = split(path[0], '.');
    } else {
        path = split(key, '.');
        path.insert(path.begin(), "formwork");
    }
    arcsim::override_value(root, path, value, origin);
}

/// Where a schema has a key.
void find_key(const JsonValue& schema, const std::string& pointer, const std::string& key, std::vector<std::string>& places) {
    if (const JsonValue* properties = schema.find("properties"))
        for (const auto& [name, value] : properties->members) {
            if (name == key) places.push_back(pointer + "/" + name);
            find_key(value, pointer + "/" + name, key, places);
        }
    if (const JsonValue* items = schema.find("items")) find_key(*items, pointer + "/0", key, places);
}

/// ArcSim's keys that make no sense for a static bag but change nothing here.
void warn_about_motion(const FormworkScene& s, std::vector<std::string>& warnings) {
    if (!s.root.handles.empty()) warnings.push_back(s.source + ": /handles hold nothing in formwork stages; /formwork/fixed does.");
}

}  // namespace

FormworkScene read_scene(const std::filesystem::path& file, const SceneOptions& options) {
    return parse_scene(arcsim::read_json(file), options);
}

FormworkScene parse_scene(arcsim::JsonDocument document, const SceneOptions& options) {
    if (document.root.kind == JsonKind::object)
        for (const std::string& override : options.overrides) apply_override(document.root, override);

    FormworkScene scene;
    scene.source = document.source;
    scene.has_formwork = document.root.find("formwork") != nullptr;
    try {
        arcsim::read_params(document, scene, scene.warnings,
                            options.ignore_unsupported ? arcsim::Unsupported::warn : arcsim::Unsupported::error);
    } catch (const arcsim::UnknownKeyError& e) {
        std::vector<std::string> places;
        if (!e.guessed) find_key(arcsim::schema_of<FormworkScene>(), "", e.key, places);
        throw InputError(e.what() + (places.empty() ? "" : " \"" + e.key + "\" exists at " + arcsim::join(places) + "."));
    }
    std::erase_if(scene.warnings, [](const std::string& w) {
        return w.find(": /$schema: ") != std::string::npos || w.find(": /expect: ") != std::string::npos;
    });
    const bool needs_mesh = !scene.formwork.tensile && !scene.formwork.fit;   // strips make their own
    if (scene.root.cloths.empty() && needs_mesh)
        throw InputError(scene.source + ": /cloths: names no mesh. Add \"cloths\": [{\"mesh\": \"bag.obj\"}].");
    if (scene.root.cloths.size() > 1 && scene.has_formwork)
        throw InputError(scene.source + ": /cloths: a formwork scene has one cloth, got " + std::to_string(scene.root.cloths.size()) +
                         ". Join the meshes into one file; it may have several components.");
    warn_about_motion(scene, scene.warnings);
    if (options.threads) {
        scene.formwork.inflate.solver.threads = *options.threads;
        scene.formwork.segment.set_threads(*options.threads);
        if (scene.formwork.sew) scene.formwork.sew->solver.threads = *options.threads;
    }
    return scene;
}

BagMesh load_bag_mesh(const FormworkScene& scene) {
    scene.mesh_file();   // there is one
    const arcsim::ClothParams& cloth = scene.root.cloths.front();
    const FormworkParams& p = scene.formwork;
    const std::string name = cloth.mesh.path.string();
    BagMesh bag = prepare_bag_mesh(read_mesh_file(cloth.mesh.path), name, {p.units, p.rest, p.weld, p.any_size});
    const arcsim::TransformParams& t = cloth.transform;
    const Vector3d axis(t.rotate[1], t.rotate[2], t.rotate[3]);
    if (t.scale != 1 || !t.translate.isZero() || (t.rotate[0] != 0 && axis.norm() > 0)) {
        const arcsim::Matrix3d R = axis.norm() > 0
                                       ? Eigen::AngleAxisd(t.rotate[0] * EIGEN_PI / 180, axis.normalized()).toRotationMatrix()
                                       : arcsim::Matrix3d::Identity();
        for (Vector3d& x : bag.cloth.x) x = t.translate + t.scale * (R * x);
        for (auto& u : bag.cloth.u) u *= t.scale;
        for (FlatTriangle& f : bag.flat)
            for (auto& u : f) u *= t.scale;
        bag.surface.x = bag.cloth.x;
    }
    return bag;
}

std::vector<char> held_dofs(const FormworkScene& scene, const BagMesh& mesh) {
    if (scene.formwork.fixed.empty())
        throw InputError(scene.source + ": /formwork/fixed: no node is held: the bag would fall. Hold its rim, for example \"fixed\": [{\"boundary\": \"top\"}].");
    return held_dofs(scene.formwork.fixed, mesh.cloth, mesh.topology, scene.formwork.up, scene.source + ": /formwork/fixed");
}

std::string effective_scene_text(const FormworkScene& scene, const std::filesystem::path& folder) {
    FormworkScene copy = scene;
    return arcsim::to_text(arcsim::write_params(copy, folder));
}

std::string scene_schema_text() {
    const JsonValue body = arcsim::schema_of<FormworkScene>();
    JsonValue schema = JsonValue::object();
    schema.set("$schema", "http://json-schema.org/draft-07/schema#");
    schema.set("title", "formwork scene");
    schema.set("description", "An ArcSim scene with a \"formwork\" object. Comments (//, /* */) are allowed. SI units.");
    for (const auto& [key, value] : body.members) schema.set(key, value);
    return arcsim::to_text(schema);
}

}  // namespace formwork
