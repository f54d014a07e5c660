#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "arcsim/base/archive.hpp"

namespace formwork {

enum class PanelSource { rest, inflated };
inline constexpr std::array panel_source_names{
    arcsim::EnumName{PanelSource::rest, "rest", "the rest surface is cut"},
    arcsim::EnumName{PanelSource::inflated, "inflated", "the inflated surface is cut"}};

enum class WarpAlong { largest_stretch, smallest_stretch };
inline constexpr std::array warp_along_names{
    arcsim::EnumName{WarpAlong::largest_stretch, "largest_stretch", "the stiffer thread carries the larger stretch"},
    arcsim::EnumName{WarpAlong::smallest_stretch, "smallest_stretch", "warp across the larger stretch"}};

enum class GrainTarget { inflated, sewn };
inline constexpr std::array grain_target_names{
    arcsim::EnumName{GrainTarget::inflated, "inflated", "the strain of the inflated bag, whose fabric is isotropic"},
    arcsim::EnumName{GrainTarget::sewn, "sewn", "the tension of the woven bag that is sewn of the panels (it is filled once more for that)"}};

enum class Corner { mitre, bevel };
inline constexpr std::array corner_names{
    arcsim::EnumName{Corner::mitre, "mitre", "allowances meet in a point, up to mitre_limit"},
    arcsim::EnumName{Corner::bevel, "bevel", "the point is cut off"}};

enum class Paper { a4, letter, a3, a0 };
inline constexpr std::array paper_names{
    arcsim::EnumName{Paper::a4, "A4", "210 x 297 mm, tiled"},
    arcsim::EnumName{Paper::letter, "Letter", "215.9 x 279.4 mm, tiled"},
    arcsim::EnumName{Paper::a3, "A3", "297 x 420 mm, tiled"},
    arcsim::EnumName{Paper::a0, "A0", "plotter: one page as large as the pattern"}};

inline std::optional<Paper> paper_of(std::string_view name) {
    for (const auto& n : paper_names)
        if (name == n.name) return n.value;
    return {};
}

enum class Lettering { characters, paths };
inline constexpr std::array lettering_names{
    arcsim::EnumName{Lettering::characters, "characters", "as text in a font"},
    arcsim::EnumName{Lettering::paths, "paths", "as single strokes, for lasers, plotters and programs without the font"}};

/// An allowance that differs from the general one.
struct SeamAllowance {
    int seam = 1;              // as printed, 1-based; rims are numbered with the seams
    double allowance_mm = 10;
};
template <class Archive>
void visit(Archive& a, SeamAllowance& p) {
    a.required("seam", p.seam, "1", arcsim::at_least(1), "Seam number as printed on the pattern, from 1.");
    a.required("allowance_mm", p.allowance_mm, "mm", arcsim::between(0, 200), "Allowance of this seam on both of its pieces.");
}

/// How the cut surface becomes pieces of cloth. Fabrication is in millimetres, hence the names.
struct PanelParams {
    PanelSource from = PanelSource::rest;
    double seam_allowance_mm = 10, hem_mm = 30;
    std::vector<SeamAllowance> allowances;
    Corner corners = Corner::mitre;
    double mitre_limit = 2;
    GrainTarget grain = GrainTarget::inflated;
    WarpAlong warp = WarpAlong::largest_stretch;
    std::array<double, 2> compensation{0, 0};   // percent that a piece is cut smaller, along warp and weft
    bool stretch_compensation = false;
    int recut = 0;
    double notch_spacing_mm = 100, notch_length_mm = 4;
    double max_distortion = 0.3, max_seam_mismatch = 0.002;
    double peak_weight = 20;
    double roll_width_mm = 1500, nest_gap_mm = 5;
    bool quarter_turns = false;
    Paper paper = Paper::a4;
    std::vector<std::string> more_papers;   // by name; one PDF each
    Lettering text = Lettering::characters;
    int cut_count = 1;
};

template <class Archive>
void visit(Archive& a, PanelParams& p) {
    using arcsim::between;
    a.choice("from", p.from, panel_source_names, "The surface that the panels are cut from.");
    a.optional("seam_allowance_mm", p.seam_allowance_mm, "mm", between(0, 200), "Cloth outside the sew line.");
    a.optional("hem_mm", p.hem_mm, "mm", between(0, 500), "Cloth outside the rim, folded in and stitched.");
    a.list("allowances", p.allowances, "Seams whose allowance differs from the general one.");
    a.choice("corners", p.corners, corner_names, "Shape of the allowance at corners.");
    a.optional("mitre_limit", p.mitre_limit, "1", between(1, 10), "Longest mitre, in allowances; longer ones are bevelled.");
    a.choice("grain", p.grain, grain_target_names, "What the grain of a panel follows.");
    a.choice("warp", p.warp, warp_along_names, "Which principal stretch the warp follows.");
    a.optional("compensation", p.compensation, "%", between(-20, 50),
               "Shrinkage of the pieces along warp and weft, so that the tightened cloth has the designed size.");
    a.optional("stretch_compensation", p.stretch_compensation,
               "Cut every face smaller by its simulated stretch, so that the filled bag has the size of the surface that is cut.");
    a.optional("recut", p.recut, "1", between(0, 9),
               "How often the panels are cut again, from the shape that the bag sewn of them takes: surplus cloth that would fold and shear "
               "goes, at the price of a shape that departs from the designed one a little more.");
    a.optional("notch_spacing_mm", p.notch_spacing_mm, "mm", between(10, 1000), "Largest distance between notches of a seam.");
    a.optional("notch_length_mm", p.notch_length_mm, "mm", between(1, 20), "Depth of a notch from the cut edge.");
    a.optional("peak_weight", p.peak_weight, "1", between(0, 1000),
               "How much more a strongly distorted face counts than a slightly distorted one when panels are laid flat; 0: all alike. "
               "Keeps stretch from piling up at corners.");
    a.optional("max_distortion", p.max_distortion, "1", between(0, 10),
               "A panel is refused when more than 5 % of its area would have to stretch or shrink by more than this.");
    a.optional("max_seam_mismatch", p.max_seam_mismatch, "1", between(1e-6, 1),
               "Largest relative difference of a seam's two sides, between any two notches.");
    a.optional("roll_width_mm", p.roll_width_mm, "mm", between(50, 20000), "Usable width of the fabric roll.");
    a.optional("nest_gap_mm", p.nest_gap_mm, "mm", between(0, 100), "Least distance between nested pieces.");
    a.optional("quarter_turns", p.quarter_turns, "Pieces may also lie across the roll (fabrics without a preferred thread).");
    a.choice("paper", p.paper, paper_names, "Paper of the printed pattern.");
    a.optional("more_papers", p.more_papers, "Further papers, a PDF each: \"A4\", \"Letter\", \"A3\", \"A0\".");
    for (const std::string& name : p.more_papers)
        a.check(paper_of(name).has_value(), "more_papers", "\"" + name + "\" is not known: \"A4\", \"Letter\", \"A3\" or \"A0\".");
    a.choice("text", p.text, lettering_names, "How names and lengths are written in the SVG and DXF files.");
    a.optional("cut_count", p.cut_count, "1", between(1, 100), "How many bags are cut; printed on every piece, counted in the bill.");
}

}  // namespace formwork
