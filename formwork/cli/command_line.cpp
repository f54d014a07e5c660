#include "formwork/cli/command_line.hpp"

#include <algorithm>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/cli/session.hpp"

namespace formwork {

namespace {

constexpr const char* examples =
    "Examples:\n"
    "  formwork run conf/column.json -o out/column    fill, cut, flatten, sew, fill again, report\n"
    "  formwork check conf/column.json                look at scene and mesh, compute nothing\n\n"
    "Lengths in m, masses in kg, stiffness of fabric in N/m, pressure in Pa; cutting patterns in mm.\n"
    "Exit codes: 0 done; 1 compare found a difference; 2 the input is wrong, nothing written over;\n"
    "3 the numbers failed, what was reached is kept; 130 interrupted, --resume goes on.\n\n";

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
    const std::string guess = arcsim::nearest_word(word, known);
    return guess.empty() ? "" : " Did you mean \"" + guess + "\"?";
}

/// CLI11 says little about slips in a command's or an option's name.
std::string explain(const CLI::App& app, const CLI::ParseError& e, int argc, char** argv) {
    const std::string first = argc > 1 ? argv[1] : "";
    const CLI::App* command = nullptr;
    std::vector<std::string> commands;
    for (const CLI::App* c : app.get_subcommands([](const CLI::App*) { return true; })) {
        commands.push_back(c->get_name());
        if (c->get_name() == first) command = c;
    }
    if (!command) {
        if (first.empty()) return "give a command: " + arcsim::join(commands) + ". `formwork --help` tells what they do.";
        return "\"" + first + "\" is not a command." + did_you_mean(first, commands) + " Commands: " + arcsim::join(commands) + ".";
    }
    std::vector<std::string> options;
    for (const CLI::Option* o : command->get_options())
        for (const std::string& name : o->get_lnames()) options.push_back("--" + name);
    for (int i = 2; i < argc; ++i) {
        const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
        if (word.starts_with("--") && std::find(options.begin(), options.end(), word) == options.end())
            return first + ": " + word + " is not an option." + did_you_mean(word, options) + " `formwork " + first + " --help` lists them.";
    }
    return first + ": " + e.what() + ". `formwork " + first + " --help` shows examples.";
}

}  // namespace

int run_command_line(int argc, char** argv) {
    CLI::App app{"Filled shape, seams and cutting patterns of plaster and concrete cast in sewn fabric.", "formwork"};
    Session session;
    app.require_subcommand(1);
    app.set_version_flag("--version", [] { return version_text(); });
    app.formatter(std::make_shared<CLI::FormatterLambda>([](const CLI::App* a, std::string name, CLI::AppFormatMode mode) {
        CLI::Formatter plain;
        plain.column_width(12);
        return examples + plain.make_help(a, name, mode);
    }));
    add_run_command(app, session);
    add_stage_commands(app, session);
    add_check_command(app, session);
    add_schema_command(app, session);
    add_init_command(app, session);
    add_mesh_command(app, session);
    add_show_command(app, session);
    add_compare_command(app, session);
    add_sweep_command(app, session);
    add_study_commands(app, session);
    add_manual_command(app, session);
    try {
        app.parse(argc, argv);   // the chosen command's callback does the work
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);   // --help, --version
        throw arcsim::InputError(explain(app, e, argc, argv));
    }
    return session.exit_code;
}

}  // namespace formwork
