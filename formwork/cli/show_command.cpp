#include <cstdio>
#include <utility>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/cli/session.hpp"
#include "formwork/stages/summary.hpp"

namespace formwork {

using arcsim::format_short;
using arcsim::JsonValue;

namespace {

void row(const std::string& what, const std::string& value) { std::printf("  %-22s %s\n", what.c_str(), value.c_str()); }

double number(const JsonValue& stage, const char* key) {
    const JsonValue* v = stage.find(key);
    return v ? v->number : 0;
}
std::string figure(const JsonValue& stage, const char* key, double factor, const char* unit) {
    return format_short(factor * number(stage, key)) + " " + unit;
}

std::string shape(const JsonValue& stage) {
    return figure(stage, "depth_m", 1000, "mm deep below the fill level, largest stretch ") + format_short(number(stage, "max_stretch"));
}

/// Ten lines that a workshop asks for first.
void show(const std::filesystem::path& dir) {
    const JsonValue summary = read_summary(dir);
    if (summary.members.empty())
        throw arcsim::InputError((dir / "summary.json").string() + ": no finished stage there. Run: formwork run SCENE -o " + dir.string());
    std::printf("\n%s\n", dir.c_str());
    double seconds = 0;
    for (const auto& [name, stage] : summary.members) seconds += number(stage, "wall_s");
    const JsonValue *inflated = summary.find("inflate"), *sewn = summary.find("sew");
    // What is cast is the sewn bag; the isotropic one is softer and only leads to its seams.
    if (const JsonValue* s = sewn ? sewn : inflated)
        row("plaster to mix", figure(*s, "volume_m3", 1000, "l, ") + figure(*s, "liquid_mass_kg", 1, "kg"));
    if (inflated) row("isotropic bag", shape(*inflated));
    if (const JsonValue* s = summary.find("segment"))
        row("panels", figure(*s, "panels", 1, "with ") + figure(*s, "seam_length_m", 1, "m of seams"));
    if (const JsonValue* s = summary.find("panels")) {
        row("cloth", figure(*s, "cloth_area_m2", 1, "m², roll ") + figure(*s, "roll_length_m", 1, "m"));
        row("flattening", "stretch error up to " + figure(*s, "max_stretch_distortion", 100, "%, mean ") + figure(*s, "mean_stretch_distortion", 100, "%"));
    }
    if (sewn) {
        row("sewn bag, woven", shape(*sewn));
        row("shear of the weave", "mean " + format_short(number(*sewn, "mean_abs_shear"), 3) + ", largest " + format_short(number(*sewn, "max_abs_shear"), 3));
    }
    for (const auto& [name, s] : {std::pair{"residual, isotropic", inflated}, std::pair{"residual, sewn", sewn}})
        if (s) row(name, format_short(number(*s, "residual"), 2) + " of the load, " + format_short(number(*s, "iterations")) + " steps");
    row("computed in", arcsim::format_short(seconds, 3) + " s");
    if (summary.find("report")) row("report", (dir / "report.html").string());
}

}  // namespace

void add_show_command(CLI::App& app, Session& session) {
    CLI::App* command = add_command(app, session, "show", "Print the main figures of an output folder",
                                    "  formwork show out/column       plaster in l and kg, seams in m, cloth in m²\n"
                                    "  formwork show out/column -q");
    auto dir = std::make_shared<std::string>();
    command->add_option("DIR", *dir, "Output folder of a run")->required()->type_name("");
    command->callback([dir] { show(*dir); });
}

}  // namespace formwork
