#include "arcsim/scene/read_scene.hpp"

#include <algorithm>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "arcsim/base/text.hpp"

namespace arcsim {
namespace {

const std::vector<std::string> modules{"proximity", "physics", "strainlimiting", "collision", "remeshing",
                                       "separation", "popfilter", "plasticity"};

bool is_empty(const JsonValue& v) {
    switch (v.kind) {
        case JsonKind::array: return v.items.empty();
        case JsonKind::object: return v.members.empty();
        case JsonKind::string: return v.string.empty();
        default: return true;
    }
}

/// A scene that may have a `formwork` section, which is for the other program.
struct PlainScene {
    SceneParams& params;
};
void visit(Archive& a, PlainScene& s) {
    visit(a, s.params);
    a.ignored("formwork", "this program simulates the cloth alone. Use the formwork program.");
}

class Judge {
public:
    Judge(const SceneParams& scene, const std::string& source, Unsupported unsupported, Warnings& warnings)
        : scene_(scene), source_(source), unsupported_(unsupported), warnings_(warnings) {}

    void refuse(const std::string& pointer, const std::string& what, const std::string& remedy) {
        const std::string text = source_ + ": " + pointer + ": " + what + " is not modelled.";
        if (unsupported_ == Unsupported::error) throw InputError(text + " " + remedy + " Or run with --ignore-unsupported.");
        warnings_.push_back(text + " Ignored as asked; the result is not ArcSim's.");
    }
    bool all_disabled(std::initializer_list<const char*> names) const {
        return std::all_of(names.begin(), names.end(), [&](const char* n) { return scene_.disables(n); });
    }

private:
    const SceneParams& scene_;
    std::string source_;
    Unsupported unsupported_;
    Warnings& warnings_;
};

}  // namespace

void check_modelled(const SceneParams& scene, const std::string& source, Unsupported unsupported, Warnings& warnings) {
    Judge judge(scene, source, unsupported, warnings);
    for (const std::string& name : scene.disable) {
        if (std::find(modules.begin(), modules.end(), name) != modules.end()) continue;
        const std::string guess = nearest_word(name, modules);
        warnings.push_back(source + ": /disable: \"" + name + "\" is no module" +
                           (guess.empty() ? "." : "; did you mean \"" + guess + "\"?") + " Modules: " + join(modules) + ".");
    }
    const bool no_contact = judge.all_disabled({"proximity", "collision"});
    if (!is_empty(scene.obstacles) && !no_contact)
        judge.refuse("/obstacles", "contact with obstacles",
                     "Remove the obstacles, or add \"proximity\", \"collision\" and \"separation\" to /disable.");
    if (!scene.cloths.empty() && !no_contact && is_empty(scene.obstacles))
        warnings.push_back(source + ": /disable: self-contact is not modelled; the cloth may pass through itself. "
                                    "Add \"proximity\" and \"collision\" to /disable to say that this is meant.");
    for (size_t c = 0; c < scene.cloths.size(); ++c) {
        const ClothParams& cloth = scene.cloths[c];
        const std::string pointer = "/cloths/" + std::to_string(c);
        if (cloth.has_remeshing && !is_empty(cloth.remeshing) && !scene.disables("remeshing"))
            judge.refuse(pointer + "/remeshing", "remeshing", "Add \"remeshing\" to /disable or remove the key.");
        for (size_t m = 0; m < cloth.materials.size(); ++m)
            if (cloth.materials[m].yield_curv < infinity && !scene.disables("plasticity"))
                judge.refuse(pointer + "/materials/" + std::to_string(m) + "/yield_curv", "plasticity",
                             "Add \"plasticity\" to /disable or remove the key.");
    }
    for (size_t h = 0; h < scene.handles.size(); ++h) {
        const HandleParams& p = scene.handles[h];
        if (p.type == HandleType::node && p.nodes.empty() && p.label < 0)
            warnings.push_back(source + ": /handles/" + std::to_string(h) + ": holds nothing: it names neither nodes nor a label.");
    }
}

Scene read_scene(const std::filesystem::path& file, Unsupported unsupported) {
    Scene scene;
    scene.text = read_text_file(file);
    const JsonDocument document = read_json(file);
    PlainScene plain{scene.params};
    read_params(JsonNode(document), plain, scene.warnings, unsupported);
    const JsonNode root(document);
    SceneParams& p = scene.params;
    if (p.cloths.empty()) root.fail("the scene has no cloths. Add \"cloths\": [{\"mesh\": \"file.obj\", \"materials\": [...]}].");
    if (p.step() <= 0) root.fail("neither \"frame_time\" nor \"timestep\" is given (s). Say how long a frame is.");
    if (p.last_time() == infinity && p.end_frame == infinity)
        scene.warnings.push_back(document.source + ": neither end_time nor end_frame is given: runs until interrupted, frame 9999 at most.");
    check_modelled(p, document.source, unsupported, scene.warnings);
    scene.motions = read_motions(JsonNode(document, p.motions, "/motions"), scene.warnings);
    scene.morphs = read_morphs(JsonNode(document, p.morphs, "/morphs"), scene.warnings);
    return scene;
}

}  // namespace arcsim
