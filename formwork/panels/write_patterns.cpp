#include <algorithm>
#include <set>

#include "arcsim/base/files.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/panels/pattern_files.hpp"
#include "formwork/panels/sewn_rest.hpp"

namespace formwork {
namespace {

constexpr std::array<std::pair<Paper, const char*>, 4> pdf_names{
    {{Paper::a4, "panels-a4.pdf"}, {Paper::letter, "panels-letter.pdf"}, {Paper::a3, "panels-a3.pdf"}, {Paper::a0, "panels-a0.pdf"}}};
constexpr const char* pieces_folder = "pieces";

std::string pdf_name(Paper paper) {
    return std::find_if(pdf_names.begin(), pdf_names.end(), [&](const auto& p) { return p.first == paper; })->second;
}

/// What an earlier run left and this one did not write again would be cut by mistake.
void remove_stale_files(const std::filesystem::path& folder, const std::vector<std::string>& written) {
    const auto is_written = [&](const std::string& name) { return std::find(written.begin(), written.end(), name) != written.end(); };
    std::error_code ignored;
    for (const auto& [paper, name] : pdf_names)
        if (!is_written(name)) std::filesystem::remove(folder / name, ignored);
    std::vector<std::filesystem::path> stale;
    for (const auto& entry : std::filesystem::directory_iterator(folder / pieces_folder)) {
        const std::string name = entry.path().filename().string(), stem = entry.path().stem().string();
        const bool is_ours = entry.path().extension() == ".svg" && stem.size() >= 3 && stem[0] == 'P' &&
                             stem.find_first_not_of("0123456789", 1) == std::string::npos;
        if (is_ours && !is_written(pieces_folder + ("/" + name))) stale.push_back(entry.path());
    }
    for (const auto& file : stale) std::filesystem::remove(file, ignored);
}

}  // namespace

PatternFiles write_patterns(const PanelSet& set, const Segmentation& s, const Pattern& pattern, const std::filesystem::path& folder) {
    std::vector<std::pair<std::string, std::string>> texts{
        {"panels.svg", pattern_svg(pattern)},
        {"panels.dxf", pattern_dxf(pattern)},
        {"panels-astm.dxf", pattern_astm(pattern)},
        {"panels.csv", panels_csv(set, pattern)},
        {"seams.csv", seams_csv(set, pattern)},
        {"seams.json", seams_json(set, s, pattern)},
        {"faces.csv", faces_csv(set)},
        {"bom.csv", bom_csv(set, pattern)},
        {"sewn_rest.obj", arcsim::format_obj(sewn_rest(set, s))}};
    std::set<Paper> papers{pattern.params.paper};
    for (const std::string& name : pattern.params.more_papers) papers.insert(paper_of(name).value());
    for (Paper paper : papers) texts.emplace_back(pdf_name(paper), pattern_pdf(pattern, paper));
    for (std::size_t i = 0; i < pattern.pieces.size(); ++i)
        texts.emplace_back(pieces_folder + ("/" + pattern.pieces[i].name) + ".svg", piece_svg(pattern, i));

    PatternFiles files;
    std::vector<std::pair<std::filesystem::path, std::string>> targets;
    for (auto& [name, text] : texts) {
        files.names.push_back(name);
        targets.emplace_back(folder / name, std::move(text));
    }
    arcsim::write_files_atomically(targets);
    remove_stale_files(folder, files.names);
    files.utilisation = pattern.nest.utilisation;
    files.utilisation_bound = pattern.nest.utilisation_bound;
    files.roll_length_m = pattern.nest.length / 1000;
    return files;
}

}  // namespace formwork
