#include <memory>

#include "arcsim/base/files.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/panels/pattern_files.hpp"
#include "formwork/panels/sewn_rest.hpp"

namespace formwork {
namespace {

std::string pdf_name(Paper paper) {
    switch (paper) {
        case Paper::a4: return "panels-a4.pdf";
        case Paper::letter: return "panels-letter.pdf";
        case Paper::a3: return "panels-a3.pdf";
        case Paper::a0: return "panels-a0.pdf";
    }
    return "panels-a4.pdf";
}

}  // namespace

PatternFiles write_patterns(const PanelSet& set, const Segmentation& s, const Pattern& pattern, const std::filesystem::path& folder) {
    const std::vector<std::pair<std::string, std::string>> texts{
        {"panels.svg", pattern_svg(pattern)},
        {"panels.dxf", pattern_dxf(pattern)},
        {"panels-astm.dxf", pattern_astm(pattern)},
        {"panels.csv", panels_csv(set, pattern)},
        {"seams.csv", seams_csv(set, pattern)},
        {"seams.json", seams_json(set, s, pattern)},
        {"bom.csv", bom_csv(set, pattern)},
        {"sewn_rest.obj", arcsim::format_obj(sewn_rest(set, s))}};
    std::filesystem::create_directories(folder);
    PatternFiles files;
    files.names.push_back(pdf_name(pattern.params.paper));
    arcsim::AtomicFile pdf(folder / files.names.back());
    write_pattern_pdf(pattern, pdf.temporary());   // the last thing that can refuse the input
    pdf.commit();
    for (const auto& [name, text] : texts) {
        arcsim::write_file_atomically(folder / name, text);
        files.names.push_back(name);
    }
    files.utilisation = pattern.nest.utilisation;
    files.roll_length_m = pattern.nest.length / 1000;
    return files;
}

}  // namespace formwork
