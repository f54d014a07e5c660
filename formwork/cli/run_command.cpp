#include <cstdio>

#include "formwork/cli/session.hpp"
#include "formwork/stages/stage.hpp"

namespace formwork {

namespace {

std::filesystem::path output_folder(const SceneArguments& arguments, const FormworkScene& scene) {
    return arguments.out.empty() ? std::filesystem::path("out") / scene.name() : std::filesystem::path(arguments.out);
}

void run(const SceneArguments& arguments, PipelineOptions options, Session& session) {
    const FormworkScene scene = read_scene(arguments.scene, {arguments.overrides, arguments.threads, arguments.ignore_unsupported});
    arcsim::Progress progress(session.verbosity());
    for (const std::string& warning : scene.warnings) progress.warning(warning);
    options.resume = arguments.resume;
    const std::filesystem::path dir = output_folder(arguments, scene);
    const std::vector<std::string> unmet = run_pipeline(scene, dir, options, progress);
    if (!session.quiet) std::printf("%s\n", (dir / (options.to.empty() || options.to == "report" ? "report.html" : "summary.json")).c_str());
    if (!unmet.empty()) {
        progress.warning(std::to_string(unmet.size()) + " bound" + (unmet.size() == 1 ? " was" : "s were") + " not met, see summary.json; the exit code is 3");
        session.exit_code = 3;
    }
}

}  // namespace

void add_run_command(CLI::App& app, Session& session) {
    CLI::App* command = add_command(app, session, "run", "Run the pipeline: inflate, segment, panels, sew, report",
                                    "  formwork run conf/column.json -o out/column                everything\n"
                                    "  formwork run conf/column.json --from segment --set segment.max_panels=12   go on from the files on disk");
    auto arguments = std::make_shared<SceneArguments>();
    auto options = std::make_shared<PipelineOptions>();
    add_scene_arguments(command, *arguments, true);
    command->add_option("--from", options->from, "First stage; earlier ones are read from the output folder")->type_name("STAGE");
    command->add_option("--to", options->to, "Last stage")->type_name("STAGE");
    command->callback([arguments, options, &session] { run(*arguments, *options, session); });
}

void add_stage_commands(CLI::App& app, Session& session) {
    struct Row {
        const char *name, *what, *trial;
    };
    for (const Row& row : {Row{"inflate", "Fill the bag: equilibrium of isotropic fabric and liquid plaster", "plaster.density=1800   kg/m³"},
                           Row{"segment", "Cut the bag into panels along its strain", "segment.max_distortion=0.08   stretch of flattening"},
                           Row{"panels", "Lay the panels flat and write cutting patterns", "panels.seam_allowance_mm=12   mm"},
                           Row{"sew", "Fill the sewn bag of woven panels", "plaster.fill='{\"volume\": 0.003}'   m³"},
                           Row{"report", "Write report.html from the files on disk", nullptr}}) {
        const std::string name = row.name;
        CLI::App* command = add_command(app, session, name, row.what, "  formwork " + name + " conf/column.json -o out/column\n  " +
            (row.trial ? "formwork " + name + " conf/column.json -o out/column --set " + row.trial : "formwork run conf/column.json -o out/column   the stages before it too"));
        auto arguments = std::make_shared<SceneArguments>();
        add_scene_arguments(command, *arguments, true);
        command->callback([arguments, name, &session] { run(*arguments, {name, name, false}, session); });
    }
}

}  // namespace formwork
