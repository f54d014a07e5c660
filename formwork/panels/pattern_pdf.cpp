#include <algorithm>
#include <cmath>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/panels/paper_sheets.hpp"
#include "formwork/panels/pattern_files.hpp"
#include "formwork/panels/pdf_page.hpp"

namespace formwork {
namespace {

constexpr double longest_page = 5080;  // mm: 14400 points, PDF's limit
constexpr double hairline = 0.15;      // mm
constexpr Colour red{0.85F, 0, 0}, blue{0, 0, 0.8F}, green{0, 0.5F, 0}, black{0, 0, 0}, grey{0.55F, 0.55F, 0.55F};

/// Draws the pieces that reach into `window` of the page, the layout's origin at `origin`.
void draw_pieces(PdfPage& page, const PaperLayout& layout, const Vector2d& origin, const Box& window) {
    for (std::size_t i = 0; i < layout.pieces.size(); ++i) {
        const PatternPiece& piece = layout.pieces[i];
        const Placement& place = layout.placement[i];
        const auto laid = [&](const Line& line) {
            Line moved;
            for (const Vector2d& p : line) moved.push_back(place(p) + origin);
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
        page.line(laid({piece.grain[0], piece.grain[1]}), false);
        for (const Line& head : grain_heads(piece)) page.line(laid(head), false);
        page.colour(black);
        for (const TextMark& t : piece.texts) page.text(place(t.at) + origin, t.height, t.angle + place.turn(), t.text, true);
    }
}

void draw_cross(PdfPage& page, const Vector2d& at) {
    page.line({at - Vector2d(4, 0), at + Vector2d(4, 0)}, false);
    page.line({at - Vector2d(0, 4), at + Vector2d(0, 4)}, false);
}

void draw_diamond(PdfPage& page, const Vector2d& at) {
    page.line({at - Vector2d(3, 0), at + Vector2d(0, 3), at + Vector2d(3, 0), at - Vector2d(0, 3)}, true);
}

/// A square to measure before cutting; its side is in the PDF exactly as long as printed beside it.
void draw_scale_box(PdfPage& page, const Vector2d& low) {
    page.colour(black), page.width(hairline);
    page.box(low, {100, 100});
    page.text(low + Vector2d(4, 6), 3, 0, "100 mm x 100 mm: measure me", false);
    page.box(low + Vector2d(4, 40), {50.8, 50.8});
    page.text(low + Vector2d(7, 44), 3, 0, "2 inch", false);
}

void draw_overview(PdfPage& page, const Pattern& pattern, const PaperLayout& layout) {
    const Vector2d paper = layout.paper;
    page.colour(black);
    double y = paper.y() - page_margin - 10;
    page.text({page_margin + 5, y}, 6, 0, pattern.info.name, false);
    const bool glued = std::any_of(layout.sheets.begin(), layout.sheets.end(), [](const PaperSheet& s) { return s.is_glued(); });
    const std::string left_out = layout.left_out.empty() ? "" : "Dashed on the map: blank sheets inside a piece, which are not printed.";
    for (const std::string& text :
         {pattern.info.date + "   " + std::to_string(pattern.pieces.size()) + " pieces, cut " + std::to_string(pattern.params.cut_count) + " of each",
          std::string("Print at 100 %, no \"fit to page\". Measure the square below before you cut."),
          glued ? "Sheets overlap by " + arcsim::format_short(sheet_overlap) + " mm: lay cross on cross, diamond on diamond, as the map below shows."
                : std::string("Every piece lies whole on its sheet: nothing has to be glued."),
          left_out,
          std::string("Red: cut. Blue, dashed: sew and fold. Green: notches; join like to like."),
          std::string("Pieces are seen from outside. Lay the arrow along the warp of the cloth: pieces are turned here to save paper.")})
        if (!text.empty()) page.text({page_margin + 5, y -= 6}, 2.4, 0, text, false);
    draw_scale_box(page, {page_margin + 5, page_margin + 5});

    // The map: every sheet with its name, and the pieces' outlines.
    const Vector2d origin(page_margin + 5, page_margin + 115);
    const Vector2d room(paper.x() - 2 * page_margin - 10, y - 6 - origin.y());
    const double scale = std::min({room.x() / layout.size.x(), room.y() / layout.size.y(), 1.0});
    page.width(hairline), page.colour(grey);
    page.dashed(true);
    for (const Box& window : layout.left_out)
        page.box(origin + scale * (window.low + Vector2d::Constant(sheet_overlap)), scale * (window.size() - Vector2d::Constant(3 * sheet_overlap)));
    page.dashed(false);
    for (const PaperSheet& sheet : layout.sheets) {
        const Vector2d low = origin + scale * sheet.window.low;
        const Vector2d size = scale * (sheet.window.size() - Vector2d::Constant(sheet.is_glued() ? sheet_overlap : 0.0));
        page.box(low, size);
        page.text(low + Vector2d(1, size.y() - 3), 2, 0, sheet.name, false);
    }
    for (std::size_t i = 0; i < layout.pieces.size(); ++i) {
        Line cut;
        for (const Vector2d& p : layout.pieces[i].cut) cut.push_back(origin + scale * layout.placement[i](p));
        page.colour(red), page.line(cut, true);
        const Room middle = widest_room(layout.pieces[i].cut);
        page.colour(black), page.text(origin + scale * layout.placement[i](middle.at) - Vector2d(0, 1), 2, 0, layout.pieces[i].name, true);
    }
}

/// Crosses at the corners, a diamond and the neighbour's name on every side that is glued.
void draw_joints(PdfPage& page, const PaperSheet& sheet, const Vector2d& room) {
    const Vector2d low = Vector2d::Constant(page_margin + sheet_overlap / 2), step = room - Vector2d::Constant(sheet_overlap);
    const Vector2d high = low + step, middle = (low + high) / 2;
    page.colour(grey), page.width(hairline);
    page.box(low, step);
    for (const Vector2d& corner : {low, Vector2d(high.x(), low.y()), high, Vector2d(low.x(), high.y())}) draw_cross(page, corner);
    struct Side {
        Vector2d at, label;
        double angle;
    };
    const std::array<Side, 4> sides{Side{{low.x(), middle.y()}, {low.x() + 6, middle.y()}, M_PI / 2},
                                    Side{{high.x(), middle.y()}, {high.x() - 3, middle.y()}, M_PI / 2},
                                    Side{{middle.x(), high.y()}, {middle.x(), high.y() - 6}, 0},
                                    Side{{middle.x(), low.y()}, {middle.x(), low.y() + 4}, 0}};
    for (std::size_t k = 0; k < sides.size(); ++k) {
        if (sheet.neighbour[k].empty()) continue;
        draw_diamond(page, sides[k].at);
        page.text(sides[k].label, 2, sides[k].angle, "to " + sheet.neighbour[k], true);
    }
}

void draw_sheet(PdfPage& page, const Pattern& pattern, const PaperLayout& layout, std::size_t index) {
    const PaperSheet& sheet = layout.sheets[index];
    const Vector2d low = Vector2d::Constant(page_margin), room = sheet.window.size();
    page.clip_to(low, room);
    draw_pieces(page, layout, low - sheet.window.low, {low, low + room});
    page.end_clip();
    if (sheet.is_glued()) draw_joints(page, sheet, room);
    page.colour(grey);
    page.text({page_margin + 8, page_margin / 2 - 1}, 2.4, 0,
              sheet.name + "   sheet " + std::to_string(index + 1) + " of " + std::to_string(layout.sheets.size()) + "   " + pattern.info.name +
                  "   " + pattern.info.date,
              false);
}

void draw_plot(PdfDocument& document, const Pattern& pattern) {
    constexpr double strip = 125;   // mm beside the pieces for the square and the title
    const PaperLayout layout = lay_on_plotter(pattern.pieces, pattern.params);
    const Vector2d size(layout.size.x() + strip + 2 * page_margin, std::max(layout.size.y(), 130.0) + 2 * page_margin);
    if (size.maxCoeff() > longest_page)
        throw arcsim::InputError("/formwork/panels/paper: one page would be " + arcsim::format_short(size.maxCoeff(), 5) + " mm long; a PDF page ends at " +
                                 arcsim::format_short(longest_page, 5) + " mm. Choose \"A4\", \"A3\" or \"Letter\".");
    PdfPage page(document, size);
    draw_pieces(page, layout, {page_margin + strip, page_margin}, {Vector2d(0, 0), size});
    draw_scale_box(page, Vector2d::Constant(page_margin));
    page.text({page_margin, page_margin + 112}, 5, 0, pattern.info.name, false);
    page.text({page_margin, page_margin + 105}, 2.4, 0, pattern.info.date + "   " + std::to_string(pattern.pieces.size()) + " pieces, cut " +
              std::to_string(pattern.params.cut_count) + " of each   print at 100 %", false);
}

}  // namespace

std::string pattern_pdf(const Pattern& pattern, Paper paper) {
    PdfDocument document(pattern.info.name);
    if (paper == Paper::a0) {
        draw_plot(document, pattern);
    } else {
        const PaperLayout layout = lay_on_sheets(pattern.pieces, pattern.params, paper);
        PdfPage overview(document, layout.paper);
        draw_overview(overview, pattern, layout);
        for (std::size_t i = 0; i < layout.sheets.size(); ++i) {
            PdfPage page(document, layout.paper);
            draw_sheet(page, pattern, layout, i);
        }
    }
    return document.finish();
}

}  // namespace formwork
