#include <algorithm>
#include <cmath>
#include <cstdio>
#include <hpdf.h>
#include <memory>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/panels/dxf_text.hpp"
#include "formwork/panels/pattern_files.hpp"
#include "formwork/panels/polygon.hpp"

namespace formwork {
namespace {

constexpr double points_per_mm = 72 / 25.4;
constexpr double page_margin = 10;     // mm that home printers cannot reach
constexpr double overlap = 10;         // mm that neighbouring sheets share, to be glued
constexpr double plotter_margin = 15;  // mm
constexpr double longest_page = 5080;  // mm: 14400 points, PDF's limit
constexpr double hairline = 0.15;      // mm
constexpr double capital_share = 0.72; // height of a capital over the font size

struct Colour {
    float r, g, b;
};
constexpr Colour red{0.85F, 0, 0}, blue{0, 0, 0.8F}, green{0, 0.5F, 0}, black{0, 0, 0}, grey{0.55F, 0.55F, 0.55F};

Vector2d paper_size(Paper paper) {   // mm
    switch (paper) {
        case Paper::a4: return {210, 297};
        case Paper::letter: return {215.9, 279.4};
        case Paper::a3: return {297, 420};
        case Paper::a0: return {841, 1189};
    }
    return {210, 297};
}

/// libharu calls back from C: the first failure is kept and thrown once the library has returned.
struct Failure {
    HPDF_STATUS error = 0, detail = 0;
};
void on_error(HPDF_STATUS error, HPDF_STATUS detail, void* failure) {
    Failure& first = *static_cast<Failure*>(failure);
    if (first.error == 0) first = {error, detail};
}

/// One page in millimetres, y up from its lower left corner.
class Page {
public:
    Page(HPDF_Doc doc, HPDF_Font font, const Vector2d& size) : page_(HPDF_AddPage(doc)), font_(font) {
        HPDF_Page_SetWidth(page_, pt(size.x()));
        HPDF_Page_SetHeight(page_, pt(size.y()));
    }

    void colour(const Colour& c) {
        HPDF_Page_SetRGBStroke(page_, c.r, c.g, c.b);
        HPDF_Page_SetRGBFill(page_, c.r, c.g, c.b);
    }
    void width(double mm) { HPDF_Page_SetLineWidth(page_, pt(mm)); }
    void dashed(bool on) {
        const HPDF_UINT16 dash[] = {4, 3};
        HPDF_Page_SetDash(page_, on ? dash : nullptr, on ? 2 : 0, 0);
    }
    void line(const Line& line, bool closed) {
        if (line.size() < 2) return;
        HPDF_Page_MoveTo(page_, pt(line[0].x()), pt(line[0].y()));
        for (std::size_t i = 1; i < line.size(); ++i) HPDF_Page_LineTo(page_, pt(line[i].x()), pt(line[i].y()));
        if (closed) HPDF_Page_ClosePath(page_);
        HPDF_Page_Stroke(page_);
    }
    void box(const Vector2d& low, const Vector2d& size) {
        HPDF_Page_Rectangle(page_, pt(low.x()), pt(low.y()), pt(size.x()), pt(size.y()));
        HPDF_Page_Stroke(page_);
    }
    void clip_to(const Vector2d& low, const Vector2d& size) {
        HPDF_Page_GSave(page_);
        HPDF_Page_Rectangle(page_, pt(low.x()), pt(low.y()), pt(size.x()), pt(size.y()));
        HPDF_Page_Clip(page_);
        HPDF_Page_EndPath(page_);
    }
    void end_clip() { HPDF_Page_GRestore(page_); }
    void text(const Vector2d& at, double capital_mm, double angle, const std::string& string, bool centred) {
        const std::string shown = ascii(string);
        HPDF_Page_SetFontAndSize(page_, font_, pt(capital_mm / capital_share));
        const double shift = centred ? HPDF_Page_TextWidth(page_, shown.c_str()) / 2 / points_per_mm : 0;
        const float c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
        HPDF_Page_BeginText(page_);
        HPDF_Page_SetTextMatrix(page_, c, s, -s, c, pt(at.x() - shift * c), pt(at.y() - shift * s));
        HPDF_Page_ShowText(page_, shown.c_str());
        HPDF_Page_EndText(page_);
    }

private:
    static float pt(double mm) { return static_cast<float>(mm * points_per_mm); }
    HPDF_Page page_;
    HPDF_Font font_;
};

/// Draws all pieces with the roll's origin at `origin` of the page.
void draw_pieces(Page& page, const Pattern& pattern, const Vector2d& origin, const Box& window) {
    for (std::size_t i = 0; i < pattern.pieces.size(); ++i) {
        const PatternPiece& piece = pattern.pieces[i];
        const Placement& place = pattern.nest.placement[i];
        const auto at = [&](const Vector2d& p) { return Vector2d(place(p) + origin); };
        const auto laid = [&](const Line& line) {
            Line moved;
            for (const Vector2d& p : line) moved.push_back(at(p));
            return moved;
        };
        const Line cut = laid(piece.cut);
        const Box box = bounding_box(cut);
        if ((box.high.array() < window.low.array()).any() || (box.low.array() > window.high.array()).any()) continue;
        page.width(2 * hairline), page.colour(red), page.line(cut, true);
        page.width(hairline), page.colour(blue), page.dashed(true), page.line(laid(piece.sew), true), page.dashed(false);
        page.colour(green);
        for (const NotchMark& notch : piece.notches)
            for (const Line& stroke : notch.strokes) page.line(laid(stroke), false);
        page.colour(blue);
        const Vector2d tail = at(piece.grain[0]), head = at(piece.grain[1]), d = (head - tail).normalized(), side(-d.y(), d.x());
        page.line({tail, head}, false);
        page.line({head - 4 * d + 1.5 * side, head, head - 4 * d - 1.5 * side}, false);
        page.line({tail + 4 * d + 1.5 * side, tail, tail + 4 * d - 1.5 * side}, false);
        page.colour(black);
        for (const TextMark& t : piece.texts) page.text(at(t.at), t.height, t.angle + place.turn(), t.text, true);
    }
}

/// Does any outline cross the window, or the window lie inside a piece?
bool has_ink(const Pattern& pattern, const Box& window) {
    const Polygon box{window.low, {window.high.x(), window.low.y()}, window.high, {window.low.x(), window.high.y()}};
    for (std::size_t i = 0; i < pattern.pieces.size(); ++i) {
        Polygon cut;
        for (const Vector2d& p : pattern.pieces[i].cut) cut.push_back(pattern.nest.placement[i](p));
        if (overlap_area(cut, box) > 0) return true;
    }
    return false;
}

struct Tiling {
    Vector2d paper, step;   // mm; step: sheet less margins and overlap
    int columns = 1, rows = 1;
    std::vector<char> used;
    int pages = 0;

    Tiling(const Pattern& pattern) : paper(paper_size(pattern.params.paper)) {
        step = paper - Vector2d::Constant(2 * page_margin + overlap);
        columns = std::max(1, static_cast<int>(std::ceil((pattern.nest.length - overlap) / step.x())));
        rows = std::max(1, static_cast<int>(std::ceil((pattern.nest.width - overlap) / step.y())));
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                used.push_back(has_ink(pattern, window(column, row)));
                pages += used.back();
            }
    }
    bool is_used(int column, int row) const {
        return column >= 0 && row >= 0 && column < columns && row < rows && used[row * columns + column];
    }
    /// The part of the roll on a sheet; row 0 is at the top.
    Box window(int column, int row) const {
        const Vector2d low(column * step.x(), (rows - 1 - row) * step.y());
        return {low, low + step + Vector2d::Constant(overlap)};
    }
    static std::string name(int column, int row) {
        std::string letters;
        for (int r = row; r >= 0; r = r / 26 - 1) letters.insert(letters.begin(), static_cast<char>('A' + r % 26));
        return letters + std::to_string(column + 1);
    }
};

void draw_cross(Page& page, const Vector2d& at) {
    page.line({at - Vector2d(4, 0), at + Vector2d(4, 0)}, false);
    page.line({at - Vector2d(0, 4), at + Vector2d(0, 4)}, false);
}

void draw_diamond(Page& page, const Vector2d& at) {
    page.line({at - Vector2d(3, 0), at + Vector2d(0, 3), at + Vector2d(3, 0), at - Vector2d(0, 3)}, true);
}

/// A square to measure before cutting; its side is in the PDF exactly as long as printed beside it.
void draw_scale_box(Page& page, const Vector2d& low) {
    page.colour(black), page.width(hairline);
    page.box(low, {100, 100});
    page.text(low + Vector2d(4, 6), 3, 0, "100 mm x 100 mm: measure me", false);
    page.box(low + Vector2d(4, 40), {50.8, 50.8});
    page.text(low + Vector2d(7, 44), 3, 0, "2 inch", false);
}

void draw_overview(Page& page, const Pattern& pattern, const Tiling& tiling) {
    const Vector2d paper = tiling.paper;
    page.colour(black);
    double y = paper.y() - page_margin - 10;
    page.text({page_margin + 5, y}, 6, 0, pattern.info.name, false);
    for (const std::string& text :
         {pattern.info.date + "   " + std::to_string(pattern.pieces.size()) + " pieces, cut " + std::to_string(pattern.params.cut_count) + " of each",
          std::string("Print at 100 %, no \"fit to page\". Measure the square below before you cut."),
          "Sheets overlap by " + arcsim::format_short(overlap) + " mm: lay cross on cross, diamond on diamond. Red: cut. Blue, dashed: sew and fold.",
          std::string("Green: notches; join single to single, double to double. Pieces are seen from outside; the arrow is the warp.")})
        page.text({page_margin + 5, y -= 6}, 2.4, 0, text, false);
    draw_scale_box(page, {page_margin + 5, page_margin + 5});

    // The map: every sheet with its name, and the pieces' outlines.
    const Vector2d room(paper.x() - 2 * page_margin - 10, y - 12 - (page_margin + 115));
    const Vector2d whole(tiling.columns * tiling.step.x() + overlap, tiling.rows * tiling.step.y() + overlap);
    const double scale = std::min({room.x() / whole.x(), room.y() / whole.y(), 1.0});
    const Vector2d origin(page_margin + 5, page_margin + 115);
    page.width(hairline);
    for (std::size_t i = 0; i < pattern.pieces.size(); ++i) {
        Line cut;
        for (const Vector2d& p : pattern.pieces[i].cut) cut.push_back(origin + scale * pattern.nest.placement[i](p));
        page.colour(red), page.line(cut, true);
        const Room middle = widest_room(pattern.pieces[i].cut);
        page.colour(black), page.text(origin + scale * pattern.nest.placement[i](middle.at), 2, 0, pattern.pieces[i].name, true);
    }
    page.colour(grey);
    for (int row = 0; row < tiling.rows; ++row)
        for (int column = 0; column < tiling.columns; ++column) {
            if (!tiling.is_used(column, row)) continue;
            const Box window = tiling.window(column, row);
            page.box(origin + scale * window.low, scale * tiling.step);
            page.text(origin + scale * (window.low + Vector2d(6, 6)) + Vector2d(0.5, 0.5), 1.8, 0, Tiling::name(column, row), false);
        }
}

void draw_tile(Page& page, const Pattern& pattern, const Tiling& tiling, int column, int row, int number) {
    const Box window = tiling.window(column, row);
    const Vector2d low = Vector2d::Constant(page_margin), size = tiling.step + Vector2d::Constant(overlap);
    page.clip_to(low, size);
    draw_pieces(page, pattern, low - window.low, {low, low + size});
    page.end_clip();
    page.colour(grey), page.width(hairline);
    const Vector2d near = low + Vector2d::Constant(overlap / 2), far = near + tiling.step;   // middle of the overlaps
    page.box(near, tiling.step);
    for (const Vector2d& corner : {near, Vector2d(far.x(), near.y()), far, Vector2d(near.x(), far.y())}) draw_cross(page, corner);
    const Vector2d middle = (near + far) / 2;
    struct Side {
        int column, row;
        Vector2d at, label;
        double angle;
    };
    for (const Side& side : {Side{column - 1, row, {near.x(), middle.y()}, {near.x() + 6, middle.y()}, M_PI / 2},
                             Side{column + 1, row, {far.x(), middle.y()}, {far.x() - 3, middle.y()}, M_PI / 2},
                             Side{column, row - 1, {middle.x(), far.y()}, {middle.x(), far.y() - 6}, 0},
                             Side{column, row + 1, {middle.x(), near.y()}, {middle.x(), near.y() + 4}, 0}}) {
        if (!tiling.is_used(side.column, side.row)) continue;
        draw_diamond(page, side.at);
        page.text(side.label, 2, side.angle, "to " + Tiling::name(side.column, side.row), true);
    }
    page.text({page_margin + 8, page_margin / 2 - 1}, 2.4, 0,
              Tiling::name(column, row) + "   sheet " + std::to_string(number) + " of " + std::to_string(tiling.pages) + "   " + pattern.info.name + "   " +
                  pattern.info.date,
              false);
}

void draw_plot(HPDF_Doc doc, HPDF_Font font, const Pattern& pattern) {
    constexpr double strip = 125;   // mm for the square and the title
    const Vector2d size(std::max(pattern.nest.length, 220.0) + 2 * plotter_margin, pattern.nest.width + strip + 2 * plotter_margin);
    if (size.maxCoeff() > longest_page)
        throw arcsim::InputError("/formwork/panels/paper: one page would be " + arcsim::format_short(size.maxCoeff(), 5) + " mm long; a PDF page ends at " +
                                 arcsim::format_short(longest_page, 5) + " mm. Choose \"A4\", \"A3\" or \"Letter\".");
    Page page(doc, font, size);
    draw_pieces(page, pattern, {plotter_margin, plotter_margin + strip}, {Vector2d(0, 0), size});
    draw_scale_box(page, {plotter_margin, plotter_margin});
    page.text({plotter_margin + 110, plotter_margin + 90}, 6, 0, pattern.info.name, false);
    page.text({plotter_margin + 110, plotter_margin + 80}, 2.4, 0, pattern.info.date + "   print at 100 %", false);
}

}  // namespace

void write_pattern_pdf(const Pattern& pattern, const std::filesystem::path& file) {
    Failure failure;
    const std::unique_ptr<std::remove_pointer_t<HPDF_Doc>, decltype(&HPDF_Free)> doc(HPDF_New(on_error, &failure), &HPDF_Free);
    HPDF_SetCompressionMode(doc.get(), HPDF_COMP_ALL);
    HPDF_SetInfoAttr(doc.get(), HPDF_INFO_TITLE, ascii(pattern.info.name).c_str());
    HPDF_SetInfoAttr(doc.get(), HPDF_INFO_CREATOR, "formwork");
    const HPDF_Font font = HPDF_GetFont(doc.get(), "Helvetica", nullptr);
    if (pattern.params.paper == Paper::a0) {
        draw_plot(doc.get(), font, pattern);
    } else {
        const Tiling tiling(pattern);
        Page overview(doc.get(), font, tiling.paper);
        draw_overview(overview, pattern, tiling);
        int number = 0;
        for (int row = 0; row < tiling.rows; ++row)
            for (int column = 0; column < tiling.columns; ++column) {
                if (!tiling.is_used(column, row)) continue;
                Page page(doc.get(), font, tiling.paper);
                draw_tile(page, pattern, tiling, column, row, ++number);
            }
    }
    HPDF_SaveToFile(doc.get(), file.c_str());
    if (failure.error != 0) {
        char code[48];
        std::snprintf(code, sizeof code, "error 0x%04lX, detail %lu", failure.error, failure.detail);
        throw arcsim::InputError("panels: " + file.string() + " cannot be written by libharu (" + code + "). Is the folder writable and the disk not full?");
    }
}

}  // namespace formwork
