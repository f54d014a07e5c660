#include <cstdio>
#include <filesystem>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "formwork/cli/session.hpp"
#include "formwork/mesher/mesh_recipe.hpp"
#include "formwork/scene/scene_guide.hpp"

namespace formwork {

namespace {

void init(const std::filesystem::path& dir, Session& session) {
    for (const char* name : {"scene.json", "bag.obj", "scene.schema.json", "woven.json"})
        if (std::filesystem::exists(dir / name))
            throw arcsim::InputError((dir / name).string() + ": is already there and is left as it is. Choose another folder.");
    const arcsim::JsonDocument sizes = arcsim::parse_json(R"({"height": 0.2, "foot_radius": 0.028, "edge": 0.006})", "formwork init");
    for (const MeshRecipe& recipe : mesh_recipes())
        if (std::string_view(recipe.name) == "vase")
            arcsim::write_file_atomically(dir / "bag.obj", recipe.make_obj(sizes, "formwork mesh vase --height 0.2 --foot-radius 0.028 --edge 0.006"));
    arcsim::write_file_atomically(dir / "woven.json", starter_material_text());
    arcsim::write_file_atomically(dir / "scene.schema.json", scene_schema_text());
    arcsim::write_file_atomically(dir / "scene.json", starter_scene_text());
    if (!session.quiet)
        std::printf("%s: scene.json with every key explained, bag.obj, woven.json, scene.schema.json\nNext: formwork run %s -o %s\n", dir.c_str(),
                    (dir / "scene.json").c_str(), (dir / "out").c_str());
}

}  // namespace

void add_init_command(CLI::App& app, Session& session) {
    CLI::App* command = add_command(app, session, "init", "Make a folder with a commented starter scene and a mesh",
                                    "  formwork init mybag                                     then edit mybag/scene.json (SI units)\n"
                                    "  formwork run mybag/scene.json -o mybag/out");
    auto dir = std::make_shared<std::string>();
    command->add_option("DIR", *dir, "Folder to make")->required()->type_name("");
    command->callback([dir, &session] { init(*dir, session); });
}

}  // namespace formwork
