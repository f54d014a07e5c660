#pragma once

#include <string_view>
#include <vector>

namespace formwork {

/// Files of formwork/report/viewer that travel inside the program, so that it can write reports
/// anywhere.
struct EmbeddedFiles {
    std::string_view page, style;
    std::vector<std::string_view> scripts;  // in the order in which they run
    std::string_view three, three_licence;
};

EmbeddedFiles embedded_files();

}  // namespace formwork
