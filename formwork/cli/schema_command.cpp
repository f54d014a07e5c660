#include <cstdio>

#include "arcsim/base/files.hpp"
#include "formwork/cli/session.hpp"
#include "formwork/scene/formwork_scene.hpp"

namespace formwork {

void add_schema_command(CLI::App& app, Session& session) {
    CLI::App* command = add_command(app, session, "schema", "Print the JSON Schema of scene files, for editors",
                                    "  formwork schema -o conf/scene.schema.json   then \"$schema\": \"scene.schema.json\" in a scene\n"
                                    "  formwork schema | less                      every key with unit, range, default");
    auto file = std::make_shared<std::string>();
    command->add_option("-o,--output", *file, "File to write; default: standard output");
    command->callback([file] {
        const std::string text = scene_schema_text();
        if (file->empty()) std::fputs(text.c_str(), stdout);
        else arcsim::write_file_atomically(*file, text);
    });
}

}  // namespace formwork
