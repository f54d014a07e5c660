#include <algorithm>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "arcsim/base/interrupt.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/scene/doubts.hpp"
#include "formwork/stages/stage.hpp"
#include "formwork/stages/summary.hpp"

namespace formwork {

using arcsim::InputError;
using arcsim::JsonValue;
namespace fs = std::filesystem;

namespace {

std::size_t stage_index(const std::string& name, std::size_t otherwise) {
    if (name.empty()) return otherwise;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < stages().size(); ++i) {
        if (stages()[i].name == name) return i;
        names.emplace_back(stages()[i].name);
    }
    const std::string guess = arcsim::nearest_word(name, names);
    throw InputError("\"" + name + "\" is not a stage." + (guess.empty() ? "" : " Did you mean \"" + guess + "\"?") +
                     " Stages: " + arcsim::join(names) + ".");
}

/// What a stage's result depends on: the whole effective scene, the files that it names, and the program.
std::string scene_fingerprint(const FormworkScene& scene) {
    std::string bytes = std::string(FORMWORK_VERSION) + effective_scene_text(scene, {});
    bytes += arcsim::read_text_file(scene.mesh_file().path);
    if (scene.formwork.segment.field) bytes += arcsim::read_text_file(scene.formwork.segment.field->path);
    const auto add_material = [&](const MaterialParams& m) {
        if (!m.data.path.empty()) bytes += arcsim::read_text_file(m.data.path);
    };
    add_material(scene.formwork.inflate.material);
    if (scene.formwork.sew) add_material(scene.formwork.sew->material);
    return fingerprint(bytes);
}

/// OUT/finished.json: stage name -> fingerprint of the inputs it was finished with.
JsonValue read_finished(const fs::path& dir) {
    std::error_code ignored;
    return fs::exists(dir / "finished.json", ignored) ? arcsim::read_json(dir / "finished.json").root : JsonValue::object();
}

bool is_finished(const JsonValue& finished, const Stage& stage, const std::string& print, const fs::path& dir) {
    const JsonValue* v = finished.find(stage.name);
    if (!v || v->string != print) return false;
    return std::all_of(stage.writes.begin(), stage.writes.end(), [&](const std::string& file) {
        std::error_code ignored;
        return fs::exists(dir / file, ignored);
    });
}

void check_reads(const Stage& stage, const FormworkScene& scene, const fs::path& dir) {
    if (stage.name == "segment" && scene.formwork.segment.field) return;   // a field file stands for the strain
    for (const std::string& file : stage.reads) {
        std::error_code ignored;
        if (!fs::exists(dir / file, ignored))
            throw InputError((dir / file).string() + ": is missing; the stage \"" + std::string(stage.name) +
                             "\" starts from it. Run the stages before it first, for example: formwork run SCENE --to " +
                             std::string(stage.name) + ".");
    }
}

void erase_key(JsonValue& object, std::string_view key) {
    std::erase_if(object.members, [&](const auto& m) { return m.first == key; });
}

}  // namespace

std::vector<std::string> run_pipeline(const FormworkScene& scene, const fs::path& dir, const PipelineOptions& options,
                                      arcsim::Progress& progress) {
    const std::vector<Stage>& table = stages();
    const std::size_t first = stage_index(options.from, 0), last = stage_index(options.to, table.size() - 1);
    if (first > last) throw InputError("--from " + options.from + " comes after --to " + options.to + ".");

    // Everything that can be wrong with the input is found before the first file is written.
    if (!scene.has_formwork)
        throw InputError(scene.source + ": has no \"formwork\" object: it is a plain cloth scene. Run it with `arcsim`, or add one (`formwork init` shows how).");
    const BagMesh mesh = load_bag_mesh(scene);
    for (const std::string& note : mesh.notes) progress.message(scene.mesh_file().path.string() + ": " + note);
    if (first == 0 && !scene.formwork.segment.field) {
        const std::vector<char> held = held_dofs(scene, mesh);
        for (const std::string& doubt : doubts_about_plaster(scene.plaster(), mesh.surface, held, scene.formwork.up))
            progress.warning(scene.source + ": " + doubt);
        if (const std::string doubt = doubt_about_up(mesh.surface, mesh.topology, scene.formwork.up); !doubt.empty())
            progress.warning(scene.mesh_file().path.string() + ": " + doubt);
    }
    const std::size_t cutting = stage_index("segment", 0);
    if (scene.formwork.segment.field && first <= cutting && cutting <= last) check_field_scene(scene);
    check_reads(table[first], scene, dir);
    const std::string print = scene_fingerprint(scene);
    JsonValue summary = read_summary(dir), finished = read_finished(dir);

    arcsim::write_file_atomically(dir / "scene.json", effective_scene_text(scene, dir));
    std::vector<std::string> unmet;
    bool skipping = options.resume;
    for (std::size_t i = first; i <= last; ++i) {
        const Stage& stage = table[i];
        if (stage.name == "inflate" && scene.formwork.segment.field && !scene.formwork.plaster) continue;   // nothing to fill
        if (stage.name == "sew" && !scene.formwork.sew) {
            progress.message("sew: left out, the scene has no \"sew\" object");
            continue;
        }
        if (skipping && is_finished(finished, stage, print, dir)) {
            progress.message(std::string(stage.name) + ": already finished for this scene");
            continue;
        }
        skipping = false;
        arcsim::throw_if_interrupted();
        check_reads(stage, scene, dir);
        for (std::size_t k = i; k < table.size(); ++k) {   // what follows belongs to other files now
            erase_key(summary, table[k].name);
            erase_key(finished, table[k].name);
        }
        arcsim::write_file_atomically(dir / "finished.json", arcsim::to_text(finished));
        progress.begin(stage.name);
        try {
            summary.set(stage.name, stage.run({scene, dir, progress}));
        } catch (const arcsim::NumericalError&) {
            write_summary(dir, summary);
            if (last + 1 < table.size() || i == last) throw;
            progress.warning("the stage " + std::string(stage.name) + " failed; the report shows what was reached");
            progress.begin("report");
            run_report({scene, dir, progress});
            throw;
        }
        write_summary(dir, summary);
        finished.set(stage.name, print);
        arcsim::write_file_atomically(dir / "finished.json", arcsim::to_text(finished));
        if (const JsonValue* violations = summary.find(stage.name)->find("violations"))
            for (const JsonValue& v : violations->items) unmet.push_back(std::string(stage.name) + ": " + v.string);
    }
    return unmet;
}

}  // namespace formwork
