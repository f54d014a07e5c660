#include "formwork/cli/command_line.hpp"

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

}  // namespace

int run_command_line(int argc, char** argv) {
    CLI::App app{"Filled shape, seams and cutting patterns of plaster and concrete cast in sewn fabric."};
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
    try {
        app.parse(argc, argv);   // the chosen command's callback does the work
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : 2;
    }
    return session.exit_code;
}

}  // namespace formwork
