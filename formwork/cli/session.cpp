#include "formwork/cli/session.hpp"

namespace formwork {

CLI::App* add_command(CLI::App& app, Session& session, const std::string& name, const std::string& what,
                      const std::string& examples) {
    CLI::App* command = app.add_subcommand(name, what);
    command->add_flag("--quiet,-q", session.quiet, "Print results and warnings only");
    command->add_flag("--json", session.json, "Progress and messages as one JSON object a line (stderr)");
    session.examples[name] = examples;
    auto formatter = std::make_shared<CLI::FormatterLambda>(
        [examples](const CLI::App* a, std::string title, CLI::AppFormatMode mode) {
            CLI::Formatter plain;
            plain.column_width(34);
            return mode == CLI::AppFormatMode::Normal ? "Examples:\n" + examples + "\n\n" + plain.make_help(a, title, mode)
                                                      : plain.make_help(a, title, mode);
        });
    command->formatter(formatter);
    return command;
}

void add_scene_arguments(CLI::App* command, SceneArguments& arguments, bool with_output) {
    command->add_option("SCENE", arguments.scene, "Scene file (JSON with comments; SI units)")->required()->type_name("FILE");
    command->add_option("--set", arguments.overrides,
                        "Override a key, below \"formwork\" or from the root with /: inflate.solver.tolerance=1e-6")
        ->type_name("KEY=VALUE")->take_all()->allow_extra_args(false);
    command->add_option("--threads", arguments.threads, "Threads to compute with; 0: as the problem's size suggests")->type_name("N")->check(CLI::Range(0, 256).description(""));
    command->add_flag("--ignore-unsupported", arguments.ignore_unsupported,
                      "Warn about keys that are not supported or not known instead of stopping");
    if (!with_output) return;
    command->add_option("-o,--output", arguments.out, "Output folder; default: out/NAME of the scene")->type_name("FOLDER");
    command->add_flag("--resume", arguments.resume, "Keep stages that are finished for this very scene, go on after them");
}

}  // namespace formwork
