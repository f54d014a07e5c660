#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "arcsim/base/json_reader.hpp"
#include "arcsim/scene/scene_params.hpp"
#include "formwork/scene/formwork_params.hpp"

namespace formwork {

/// A scene file: an ArcSim scene with a `formwork` object.
struct FormworkScene {
    std::string source;                  // the file, as the user named it
    arcsim::SceneParams root;
    FormworkParams formwork;
    bool has_formwork = false;
    std::vector<std::string> warnings;

    /// @throws InputError: a scene of strips alone names no mesh
    const arcsim::InputFile& mesh_file() const;
    /// "column" of conf/column.json: names things after the scene.
    std::string name() const { return std::filesystem::path(source).stem().string(); }
    /// The liquid, or an error that names the missing key: for stages that need it.
    const PlasterParams& plaster() const;
};
void visit(arcsim::Archive& a, FormworkScene& s);

struct SceneOptions {
    std::vector<std::string> overrides;   // "inflate.solver.tolerance=1e-6", "/gravity=[0,0,-1]"
    std::optional<int> threads;           // replaces every solver.threads
    bool ignore_unsupported = false;      // ArcSim keys that would change the result: warn instead of stop
};

/// Reads and checks a scene file; touches nothing else.
/// @throws InputError
FormworkScene read_scene(const std::filesystem::path& file, const SceneOptions& options = {});
FormworkScene parse_scene(arcsim::JsonDocument document, const SceneOptions& options = {});

/// Loads the mesh that the scene names, in metres and in place. Notes about it are appended to `warnings`
/// only when something had to be changed.
BagMesh load_bag_mesh(const FormworkScene& scene);

/// Held degrees of freedom of that mesh, 3n flags.
std::vector<char> held_dofs(const FormworkScene& scene, const BagMesh& mesh);

/// The scene with every default filled in; file names relative to `folder`.
std::string effective_scene_text(const FormworkScene& scene, const std::filesystem::path& folder);

/// JSON Schema of the whole file, from the same visits that read it.
std::string scene_schema_text();

}  // namespace formwork
