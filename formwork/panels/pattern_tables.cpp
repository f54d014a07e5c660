#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "arcsim/base/text.hpp"
#include "formwork/panels/marks.hpp"
#include "formwork/panels/pattern_files.hpp"
#include "formwork/panels/polygon.hpp"

namespace formwork {
namespace {

constexpr double mm = 1000;   // per metre

std::string number(double v) { return arcsim::format_short(v, 8); }

int step_of(const Pattern& pattern, int seam) {
    const auto has_it = [&](const SewingStep& step) { return std::find(step.seams.begin(), step.seams.end(), seam) != step.seams.end(); };
    return static_cast<int>(std::find_if(pattern.order.begin(), pattern.order.end(), has_it) - pattern.order.begin()) + 1;
}

std::string first_notch(const PanelSeam& seam) {
    if (seam.is_rim()) return "none";
    return notch_words(notch_style(seam.style));
}

/// A field that a spreadsheet leaves alone.
std::string quoted(const std::string& s) {
    std::string out = "\"";
    for (char c : s) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

}  // namespace

std::string panels_csv(const PanelSet& set, const Pattern& pattern) {
    std::ostringstream out;
    out << "panel,name,faces,area_m2,surface_area_m2,cut_area_m2,perimeter_mm,cut_perimeter_mm,warp_size_mm,weft_size_mm,cut_warp_size_mm,"
           "cut_weft_size_mm,mean_distortion,p95_distortion,max_distortion,area_change,symmetric_dirichlet,grain_deviation_deg,"
           "grain_coherence,turn_on_roll_deg,flips,overlaps\n";
    for (std::size_t i = 0; i < set.panels.size(); ++i) {
        const FlatPanel& p = set.panels[i];
        const PatternPiece& piece = pattern.pieces[i];
        const Vector2d sew = bounding_box(piece.sew).size(), cut = bounding_box(piece.cut).size();
        out << i + 1 << ',' << piece.name << ',' << p.faces.size() << ',' << number(p.area) << ',' << number(p.rest_area) << ','
            << number(piece.cut_area / mm / mm) << ',' << number(perimeter(piece.sew)) << ',' << number(perimeter(piece.cut)) << ','
            << number(sew.x()) << ',' << number(sew.y()) << ',' << number(cut.x()) << ',' << number(cut.y()) << ','
            << number(p.mean_stretch_distortion) << ',' << number(p.p95_stretch_distortion) << ',' << number(p.max_stretch_distortion) << ','
            << number(p.area / p.rest_area - 1) << ',' << number(p.symmetric_dirichlet) << ',' << number(p.grain_deviation_deg) << ','
            << number(p.grain_coherence) << ',' << 90 * pattern.nest.placement[i].quarter_turns << ',' << p.flips << ',' << int(p.overlaps) << '\n';
    }
    return out.str();
}

std::string seams_csv(const PanelSet& set, const Pattern& pattern) {
    std::ostringstream out;
    out << "seam,name,panel_a,panel_b,length_a_mm,length_b_mm,mismatch,mismatch_between_notches,surface_length_mm,allowance_mm,notches,"
           "first_notch,step,kind\n";
    for (std::size_t i = 0; i < set.seams.size(); ++i) {
        const PanelSeam& seam = set.seams[i];
        const int step = step_of(pattern, static_cast<int>(i));
        out << i + 1 << ',' << seam_name(set, static_cast<int>(i)) << ',' << panel_name(seam.side[0].panel) << ','
            << (seam.is_rim() ? "" : panel_name(seam.side[1].panel)) << ',' << number(mm * seam.side[0].length) << ','
            << (seam.is_rim() ? "" : number(mm * seam.side[1].length)) << ',' << number(seam.mismatch) << ',' << number(seam.local_mismatch)
            << ',' << number(mm * seam.rest_length) << ',' << number(allowance_mm(set, static_cast<int>(i))) << ',' << seam.notch.size() << ','
            << first_notch(seam) << ',' << step << ',' << to_string(pattern.order[step - 1].kind) << '\n';
    }
    return out.str();
}

std::string seams_json(const PanelSet& set, const Segmentation& s, const Pattern& pattern) {
    nlohmann::ordered_json seams = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < set.seams.size(); ++i) {
        const PanelSeam& seam = set.seams[i];
        nlohmann::ordered_json entry{{"seam", i + 1}, {"name", seam_name(set, static_cast<int>(i))}, {"rim", seam.is_rim()}};
        entry["surface_length_mm"] = mm * seam.rest_length;
        entry["allowance_mm"] = allowance_mm(set, static_cast<int>(i));
        entry["mismatch"] = seam.mismatch;
        entry["notches"] = seam.notch;
        entry["first_notch"] = first_notch(seam);
        entry["step"] = step_of(pattern, static_cast<int>(i));
        entry["nodes"] = s.seams[i].nodes;
        for (const SeamSide& side : seam.side) {
            if (side.panel < 0) continue;
            nlohmann::ordered_json chain = nlohmann::ordered_json::array();
            for (const Vector2d& u : flat_chain(set, side)) chain.push_back({mm * u.x(), mm * u.y()});
            entry["sides"].push_back({{"panel", side.panel + 1}, {"name", panel_name(side.panel)}, {"length_mm", mm * side.length}, {"points_mm", chain}});
        }
        seams.push_back(std::move(entry));
    }
    nlohmann::ordered_json order = nlohmann::ordered_json::array();
    for (const SewingStep& step : pattern.order) {
        nlohmann::ordered_json entry{{"step", order.size() + 1}, {"kind", std::string(to_string(step.kind))}};
        for (int seam : step.seams) entry["seams"].push_back(seam_name(set, seam));
        for (int panel : step.panels) entry["pieces"].push_back(panel_name(panel));
        order.push_back(std::move(entry));
    }
    return nlohmann::ordered_json{{"name", pattern.info.name}, {"units", "mm"}, {"seams", seams}, {"assembly", order}}.dump(1) + "\n";
}

std::string faces_csv(const PanelSet& set) {
    std::size_t n = 0;
    for (const FlatPanel& p : set.panels) n += p.face.size();
    std::vector<std::string> row(n);
    for (const FlatPanel& p : set.panels)
        for (std::size_t k = 0; k < p.face.size(); ++k)
            row[p.face[k]] = std::to_string(p.face[k]) + ',' + panel_name(p.id) + ',' + arcsim::format_short(p.face_distortion[k], 4) + ',' +
                             arcsim::format_short(p.grain_error_deg[k], 4) + '\n';
    std::string out = "face,panel,distortion,grain_error_deg\n";
    for (const std::string& r : row) out += r;
    return out;
}

std::string bom_csv(const PanelSet& set, const Pattern& pattern) {
    const double count = set.params.cut_count;
    double sewn = 0, hemmed = 0, sew_area = 0, cut_area = 0;
    for (const PanelSeam& seam : set.seams) (seam.is_rim() ? hemmed : sewn) += seam.side[0].length;
    for (const PatternPiece& piece : pattern.pieces) cut_area += piece.cut_area / mm / mm, sew_area += signed_area(piece.sew) / mm / mm;
    std::ostringstream out;
    out << "item,quantity,unit,note\n";
    const auto row = [&](const std::string& item, double quantity, const char* unit, const std::string& note) {
        out << item << ',' << arcsim::format_short(quantity, 6) << ',' << unit << ',' << quoted(note) << '\n';
    };
    row("bags", count, "pcs", pattern.info.name);
    row("pieces", count * static_cast<double>(pattern.pieces.size()), "pcs", "");
    row("fabric", pattern.roll_length / mm, "m", "of a roll " + number(set.params.roll_width_mm) + " mm wide, all bags nested together");
    row("fabric_area", count * cut_area, "m2", "pieces with allowances");
    row("fabric_area_net", count * sew_area, "m2", "inside the sew lines");
    row("utilisation", 100 * pattern.nest.utilisation, "%",
        "of the roll used for one bag; the roll's width, the longest piece and the area allow " + arcsim::format_short(100 * pattern.nest.utilisation_bound, 3) + " %");
    if (pattern.info.fabric_density > 0) row("fabric_mass", count * cut_area * pattern.info.fabric_density, "kg", "");
    row("seams", count * sewn, "m", "");
    row("hems", count * hemmed, "m", "");
    if (pattern.info.liquid_m3 > 0) row("liquid", count * pattern.info.liquid_m3 * 1000, "l", "below the fill level of the inflated bag");
    if (pattern.info.liquid_kg > 0) row("liquid_mass", count * pattern.info.liquid_kg, "kg", "");
    return out.str();
}

}  // namespace formwork
