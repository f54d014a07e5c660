#include <cstdio>

#include "arcsim/base/files.hpp"
#include "formwork/cli/session.hpp"
#include "formwork/scene/formwork_scene.hpp"
#include "formwork/scene/scene_reference.hpp"

namespace formwork {

void add_schema_command(CLI::App& app, Session& session) {
    CLI::App* command = add_command(app, session, "schema", "Print the JSON Schema of scene files, for editors",
                                    "  formwork schema -o conf/scene.schema.json   then \"$schema\": \"scene.schema.json\" in a scene\n"
                                    "  formwork schema | less                      every key with unit, range, default");
    auto file = std::make_shared<std::string>();
    auto markdown = std::make_shared<bool>(false);
    command->add_option("-o,--output", *file, "File to write; default: standard output")->type_name("FILE");
    command->add_flag("--markdown", *markdown, "The same for people: tables of keys, as in docs/scene.md");
    command->callback([file, markdown] {
        const std::string text = *markdown ? scene_reference_text() : scene_schema_text();
        if (file->empty()) std::fputs(text.c_str(), stdout);
        else arcsim::write_file_atomically(*file, text);
    });
}

}  // namespace formwork
