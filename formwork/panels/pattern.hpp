#pragma once

#include <array>
#include <string>
#include <vector>

#include "formwork/panels/notches.hpp"
#include "formwork/panels/panel_set.hpp"

namespace formwork {

using arcsim::Vector3d;

/// What is printed beside the pieces; the stage knows it, the panels do not.
struct PatternInfo {
    std::string name = "bag";   // of the scene
    std::string date;           // yyyy-mm-dd; empty: today
    Vector3d up{0, 0, 1};       // tells which seam is the pouring opening of a closed bag
    double liquid_m3 = 0, liquid_kg = 0;   // for the bill; 0: unknown
    double fabric_density = 0;             // kg/m²; 0: unknown
};

/// Millimetres from here on; x along the warp, y along the weft, y up, seen from outside.
using Line = std::vector<Vector2d>;

struct NotchMark {
    int seam = 0;
    struct Foot {
        NotchShape shape;
        Vector2d at;              // on the cut line
    };
    std::vector<Foot> feet;       // one per stroke
    Vector2d sew, cut;            // the middle's points on the sew line and on the cut line
    std::vector<Line> strokes;    // in the allowance, from the cut line inwards
};

struct TextMark {
    Vector2d at;          // middle of the base line
    double height = 3;    // of capitals, mm
    double angle = 0;     // rad
    std::string text;
    int seam = -1;        // that it names; -1: the piece
};

/// Which seam an edge of the sew line belongs to, and which side of it.
struct SewEdge {
    int seam = 0, side = 0;
    bool rim = false;   // folded and hemmed, not sewn to another piece
    bool operator==(const SewEdge&) const = default;
};

/// One piece of cloth as it is cut and marked.
struct PatternPiece {
    int panel = 0;
    std::string name;                  // P03
    Line sew, cut;                     // closed, counter-clockwise, first point not repeated
    std::vector<SewEdge> sew_seam;     // per edge of `sew`
    std::vector<Line> folds;           // rim: the hem is folded here; on the sew line
    std::vector<NotchMark> notches;
    std::array<Vector2d, 2> grain;     // arrow along the warp, tail and head
    std::vector<TextMark> texts;
    double cut_area = 0;               // mm²
};

/// The two heads of the grain arrow.
std::array<Line, 2> grain_heads(const PatternPiece& piece);

/// The piece with all its marks turned about the origin, rad.
PatternPiece turned_piece(PatternPiece piece, double angle);

/// Where a piece lies on the roll: turned by 90° times quarter_turns, then moved.
struct Placement {
    int quarter_turns = 0;
    Vector2d offset{0, 0};
    Vector2d operator()(const Vector2d& p) const;
    double turn() const { return quarter_turns * 1.5707963267948966; }
};

/// All pieces on the roll: x along it, y across, both from 0.
struct Nest {
    std::vector<Placement> placement;   // per piece
    double length = 0, width = 0;       // of the rectangle in use, mm
    double utilisation = 0;             // area of the pieces over roll width times length
    double utilisation_bound = 0;       // no nesting reaches more: the roll is as long as the longest piece or the area asks
};

enum class StepKind { dart, join, close, hem, opening };
std::string_view to_string(StepKind k);

/// One seam or hem of the assembly, in order.
struct SewingStep {
    StepKind kind = StepKind::join;
    std::vector<int> seams;    // one; of a hem: the rims of one loop, as they follow each other
    std::vector<int> panels;   // that it joins: two, one for a dart; of a hem: the pieces around the loop
    double open_before = 0;    // m of still open edges of the parts at hand, beside this seam: the hand's way out
};

struct Pattern {
    PatternInfo info;
    PanelParams params;
    std::vector<PatternPiece> pieces;
    Nest nest;                  // of one bag
    double roll_length = 0;     // mm, for all params.cut_count bags nested together
    std::vector<SewingStep> order;
};

/// Allowances, marks, labels, nesting and sewing order of a set of panels.
/// @throws InputError  the roll is narrower than a piece, an allowance names no seam
Pattern make_pattern(const PanelSet& set, const Segmentation& s, const PatternInfo& info);

}  // namespace formwork
