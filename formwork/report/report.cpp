#include "formwork/report/report.hpp"

#include <string_view>

#include "arcsim/base/files.hpp"
#include "formwork/report/embedded_files.hpp"
#include "formwork/report/report_data.hpp"

namespace formwork {
namespace {

std::string escape_html(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

/// Within a script element nothing may look like markup: "<" is written as the same character in JSON's own way.
std::string escape_script_data(const std::string& json) {
    std::string out;
    out.reserve(json.size());
    for (const char c : json) {
        if (c == '<')
            out += "\\u003c";
        else
            out += c;
    }
    return out;
}

}  // namespace

std::string compose_report(const ReportInput& input) {
    const EmbeddedFiles files = embedded_files();
    std::string scripts;
    for (const std::string_view s : files.scripts) scripts.append(s);
    const std::pair<std::string_view, std::string> parts[] = {
        {"{{title}}", escape_html(input.title)},
        {"{{style}}", std::string(files.style)},
        {"{{data}}", escape_script_data(report_data(input))},
        {"{{three_licence}}", std::string(files.three_licence)},
        {"{{three}}", std::string(files.three)},
        {"{{script}}", scripts},
    };
    std::string out;
    for (std::string_view rest = files.page; !rest.empty();) {
        const size_t open = rest.find("{{");
        out.append(rest.substr(0, open));
        if (open == std::string_view::npos) break;
        rest.remove_prefix(open);
        bool known = false;
        for (const auto& [name, text] : parts)
            if (rest.substr(0, name.size()) == name) {
                out += text;
                rest.remove_prefix(name.size());
                known = true;
                break;
            }
        if (!known) out += "{{", rest.remove_prefix(2);
    }
    return out;
}

void write_report(const ReportInput& input, const std::filesystem::path& path) {
    arcsim::write_file_atomically(path, compose_report(input));
}

}  // namespace formwork
