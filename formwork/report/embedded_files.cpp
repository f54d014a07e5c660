#include "formwork/report/embedded_files.hpp"

// The assembler copies the files into the read-only data of the program; the build names the folder
// to it (CMakeLists.txt) and makes this file depend on them.
#define EMBED(name, file)                                                                 \
    __asm__(".section .rodata\n.global formwork_" #name "_begin\n.global formwork_" #name \
            "_end\nformwork_" #name "_begin:\n.incbin \"" file "\"\nformwork_" #name      \
            "_end:\n.byte 0\n.previous\n");                                               \
    extern "C" const char formwork_##name##_begin[], formwork_##name##_end[];

EMBED(page, "report.html")
EMBED(style, "report.css")
EMBED(script_data, "data.js")
EMBED(script_tables, "tables.js")
EMBED(script_flat, "flat.js")
EMBED(script_view, "view.js")
EMBED(script_main, "main.js")
EMBED(three, "vendor/three.min.js")
EMBED(three_licence, "vendor/three.LICENSE")

namespace formwork {

#define VIEW(name)                            \
    std::string_view(formwork_##name##_begin, \
                     static_cast<size_t>(formwork_##name##_end - formwork_##name##_begin))

EmbeddedFiles embedded_files() {
    return {VIEW(page),
            VIEW(style),
            {VIEW(script_data), VIEW(script_tables), VIEW(script_flat), VIEW(script_view),
             VIEW(script_main)},
            VIEW(three),
            VIEW(three_licence)};
}

}  // namespace formwork
