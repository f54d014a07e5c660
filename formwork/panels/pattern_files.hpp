#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "formwork/panels/pattern.hpp"

namespace formwork {

/// Each format is text of its own; lengths in millimetres, at 1:1.

/// One user unit is 1 mm. Layers cut (red), sew and fold (blue), notch (green), grain, label, guide; hairlines,
/// no fills, no line twice. Paths carry data-piece and data-seam. Lettering as params.text says.
std::string pattern_svg(const Pattern& pattern);
/// The same of one piece alone, unturned.
std::string piece_svg(const Pattern& pattern, std::size_t piece);

/// DXF R12 for CAD and laser programs: layers CUT, SEW, NOTCH, GRAIN, LABEL; outlines are closed polylines, and
/// no line is drawn twice: the rim is part of SEW.
std::string pattern_dxf(const Pattern& pattern);

/// DXF in the dialect of apparel CAD, ASTM D6673 with AAMA layer numbers: one block per piece, boundary on 1,
/// turn points 2, curve points 3, notches 4, grain line 7, internal lines 8, sew line 14, notes 15, exact
/// copies on 84, 85 and 87. Neither tables nor non-ASCII text, which the strict readers refuse.
/// @throws InputError  a piece without grain line or with fewer than three points
std::string pattern_astm(const Pattern& pattern);

/// The bytes of a PDF on `paper`: an overview with page map, 100 mm square and instructions, then the sheets, with
/// overlap, corner crosses and neighbours' names where they are glued; on A0 one page as large as the pattern.
/// @throws InputError  the one page would be longer than PDF allows
std::string pattern_pdf(const Pattern& pattern, Paper paper);

/// One row per panel: sizes in mm and m², distortion, grain.
std::string panels_csv(const PanelSet& set, const Pattern& pattern);
/// One row per seam and rim: neighbours, both lengths, mismatch, notches, allowance, step of assembly.
std::string seams_csv(const PanelSet& set, const Pattern& pattern);
/// The same with notch positions and the chains of vertices, for programs.
std::string seams_json(const PanelSet& set, const Segmentation& s, const Pattern& pattern);
/// One row per face of the cut mesh: its panel, max |sigma - 1|, and the angle between its target direction and
/// the weave, modulo 90°: where a curved grain would serve better.
std::string faces_csv(const PanelSet& set);
/// Bill of materials: fabric by roll width, seam and hem metres, liquid.
std::string bom_csv(const PanelSet& set, const Pattern& pattern);

/// What a stage reports about its files.
struct PatternFiles {
    std::vector<std::string> names;   // relative to the folder
    double utilisation = 0, utilisation_bound = 0;   // of the roll; what no nesting exceeds
    double roll_length_m = 0;
};

/// Writes panels.svg, pieces/P01.svg ..., panels.dxf, panels-astm.dxf, panels-<paper>.pdf of every paper, panels.csv, seams.csv,
/// seams.json, faces.csv, bom.csv and sewn_rest.obj. Everything is computed first, then written to temporary
/// names, then renamed: an error leaves the folder as it was. Pieces and papers of an earlier run are removed.
PatternFiles write_patterns(const PanelSet& set, const Segmentation& s, const Pattern& pattern,
                            const std::filesystem::path& folder);

}  // namespace formwork
