#include <cstdio>
#include <functional>

#include "arcsim/base/files.hpp"
#include "formwork/cli/session.hpp"

namespace formwork {

namespace {

bool is_visible(const CLI::App* a) { return !a->get_group().empty(); }

/// Text for troff: hyphens that can be copied, no line taken for a request.
std::string roff(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) out += "\\&";
        if (c == '\\') out += "\\e";
        else if (c == '-') out += "\\-";
        else out += c;
    }
    return out;
}

std::string synopsis(const CLI::Option* o) {
    const std::string value = o->get_expected_max() > 0 && !o->get_type_name().empty() ? " " + o->get_type_name() : "";
    return o->get_positional() ? o->get_name(true) : o->get_name(false, true) + value;
}

void describe_options(const CLI::App* a, std::string& out) {
    for (const CLI::Option* o : a->get_options())
        out += ".TP\n\\fB" + roff(synopsis(o)) + "\\fR\n" + roff(o->get_description()) + "\n";
}

/// The page formwork(1): every command with its examples and options, as its help tells them.
std::string man_page(const CLI::App& app, const Session& session) {
    std::string out = ".TH FORMWORK 1 \"\" \"formwork " FORMWORK_VERSION "\" \"User Commands\"\n.SH NAME\nformwork \\- " +
                      roff(app.get_description()) + "\n.SH SYNOPSIS\n\\fBformwork\\fR COMMAND [OPTIONS] ...\n";
    out += ".SH DESCRIPTION\nFrom a surface mesh and a scene file to the shape of the filled bag, its seams and cutting patterns, and the sewn bag.\n"
           ".PP\nLengths in m, masses in kg, stiffness of fabric in N/m, pressure in Pa; cutting patterns in mm.\n";
    out += ".SH COMMANDS\n";
    for (const CLI::App* command : app.get_subcommands(is_visible)) {
        out += ".SS \"formwork " + roff(command->get_name()) + "\"\n" + roff(command->get_description()) + ".\n";
        const auto examples = session.examples.find(command->get_name());
        if (examples != session.examples.end()) out += ".PP\n.nf\n" + roff(examples->second) + "\n.fi\n";
        describe_options(command, out);
        if (const std::string footer = command->get_footer(); footer.size() > 1) out += ".PP\n.nf\n" + roff(footer) + "\n.fi\n";
    }
    out += ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\n\\fBcompare\\fR found a difference beyond its tolerance\n.TP\n2\nthe input is wrong; nothing was "
           "written over\n.TP\n3\nthe numbers failed or a bound of the scene was not met; what was reached is kept and named\n.TP\n130\ninterrupted; "
           "\\fB\\-\\-resume\\fR goes on after the finished stages\n.SH SEE ALSO\narcsim(1), and the pages under /usr/share/doc/formwork\n";
    return out;
}

/// Completion for bash: commands, their options, stages after --from and --to, else files.
std::string bash_completion(const CLI::App& app) {
    std::string commands, cases;
    for (const CLI::App* command : app.get_subcommands(is_visible)) {
        commands += " " + command->get_name();
        cases += "        " + command->get_name() + ") options=\"";
        for (const CLI::Option* o : command->get_options())
            for (const std::string& name : o->get_lnames()) cases += "--" + name + " ";
        cases.back() = '"';
        cases += " ;;\n";
    }
    return "# bash completion for formwork; written by: formwork manual --bash-completion\n"
           "_formwork() {\n"
           "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} options=\"--help --version\"\n"
           "    case ${COMP_WORDS[1]} in\n" + cases + "    esac\n"
           "    if ((COMP_CWORD == 1)); then COMPREPLY=($(compgen -W \"" + commands.substr(1) + " $options\" -- \"$word\"))\n"
           "    elif [[ $before == --from || $before == --to ]]; then COMPREPLY=($(compgen -W \"inflate segment panels sew report\" -- \"$word\"))\n"
           "    elif [[ $word == -* ]]; then COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
           "    else compopt -o filenames; COMPREPLY=($(compgen -f -- \"$word\"))\n"
           "    fi\n"
           "}\n"
           "complete -F _formwork formwork\n";
}

}  // namespace

void add_manual_command(CLI::App& app, Session& session) {
    CLI::App* command = add_command(app, session, "manual", "Write the manual page, or bash completion",
                                    "  formwork manual -o formwork.1                 read it with: man ./formwork.1\n"
                                    "  source <(formwork manual --bash-completion)   completion for this shell");
    auto file = std::make_shared<std::string>();
    auto completion = std::make_shared<bool>(false);
    command->add_option("-o,--output", *file, "File to write; default: standard output")->type_name("FILE");
    command->add_flag("--bash-completion", *completion, "Write a bash completion script instead");
    command->callback([file, completion, &app, &session] {
        const std::string text = *completion ? bash_completion(app) : man_page(app, session);
        if (file->empty()) std::fputs(text.c_str(), stdout);
        else arcsim::write_file_atomically(*file, text);
    });
}

}  // namespace formwork
