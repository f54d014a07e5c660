#include <algorithm>
#include <cstdio>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/cli/session.hpp"
#include "formwork/mesher/mesh_recipe.hpp"

namespace formwork {

using arcsim::InputError;
using arcsim::JsonValue;

namespace {

/// "--bottom-radius" of the key "bottom_radius".
std::string option_name(std::string key) {
    std::replace(key.begin(), key.end(), '_', '-');
    return "--" + key;
}

std::string kinds_text() {
    std::string text;
    for (const MeshRecipe& r : mesh_recipes()) {
        text += "\n" + std::string(r.name) + ": " + r.what + "\n";
        const JsonValue schema = r.schema();
        for (const auto& [key, value] : schema.find("properties")->members) {
            std::string line = "  " + option_name(key);
            line.resize(std::max<std::size_t>(line.size() + 1, 20), ' ');
            if (const JsonValue* doc = value.find("description")) line += doc->string;
            if (const JsonValue* d = value.find("default")) line += " Default " + arcsim::to_text_one_line(*d) + ".";
            text += line + "\n";
        }
    }
    return text;
}

arcsim::JsonDocument keys_of(const std::string& kind, const std::vector<std::string>& words) {
    arcsim::JsonDocument document{"formwork mesh " + kind, {}, JsonValue::object()};
    for (std::size_t i = 0; i < words.size(); ++i) {
        std::string word = words[i];
        if (!word.starts_with("--")) throw InputError("formwork mesh " + kind + ": expected an option such as --edge, got \"" + word + "\".");
        word.erase(0, 2);
        std::string value;
        if (const std::size_t equals = word.find('='); equals != std::string::npos) {
            value = word.substr(equals + 1);
            word.erase(equals);
        } else if (i + 1 < words.size()) {
            value = words[++i];
        } else {
            throw InputError("formwork mesh " + kind + ": --" + word + " needs a value.");
        }
        std::replace(word.begin(), word.end(), '-', '_');
        arcsim::override_value(document.root, {word}, value, "formwork mesh " + kind);
    }
    return document;
}

}  // namespace

void add_mesh_command(CLI::App& app, Session& session) {
    CLI::App* command = add_command(app, session, "mesh", "Make a mesh: disk, sock, column, pillow, sphere, strip, vase",
                                    "  formwork mesh column --height 0.3 --edge 0.004 -o column.obj   sizes in metres\n"
                                    "  formwork mesh disk --radius 0.15 --edge 0.01 -o disk.obj");
    auto kind = std::make_shared<std::string>();
    auto file = std::make_shared<std::string>();
    command->add_option("KIND", *kind, "What to make; see below")->required()->type_name("");
    command->add_option("-o,--output", *file, "OBJ file to write; default: standard output")->type_name("FILE");
    command->allow_extras();
    command->footer([] { return "Kinds and their sizes:" + kinds_text(); });
    command->callback([command, kind, file, &session] {
        const std::vector<MeshRecipe>& recipes = mesh_recipes();
        const auto recipe = std::find_if(recipes.begin(), recipes.end(), [&](const MeshRecipe& r) { return r.name == *kind; });
        if (recipe == recipes.end()) {
            std::vector<std::string> names;
            for (const MeshRecipe& r : recipes) names.emplace_back(r.name);
            const std::string guess = arcsim::nearest_word(*kind, names);
            throw InputError("formwork mesh: \"" + *kind + "\" is not a kind of mesh." + (guess.empty() ? "" : " Did you mean \"" + guess + "\"?") +
                             " Known: " + arcsim::join(names) + ".");
        }
        const std::vector<std::string> words = command->remaining();
        const std::string comment = "formwork mesh " + *kind + (words.empty() ? "" : " " + arcsim::join(words, " "));
        const std::string obj = recipe->make_obj(keys_of(*kind, words), comment);
        if (file->empty()) std::fputs(obj.c_str(), stdout);
        else arcsim::write_file_atomically(*file, obj);
        if (!file->empty() && !session.quiet) {
            const auto count = [&](const char* start) {
                long n = 0;
                for (std::size_t at = obj.find(start); at != std::string::npos; at = obj.find(start, at + 1)) ++n;
                return std::to_string(n);
            };
            std::fprintf(stderr, "%s: %s vertices, %s faces\n", file->c_str(), count("\nv ").c_str(), count("\nf ").c_str());
        }
    });
}

}  // namespace formwork
