#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "formwork/panels/pattern_files.hpp"
#include "formwork/panels/polygon.hpp"
#include "formwork/panels/text_strokes.hpp"

namespace formwork {
namespace {

constexpr double margin = 10;          // mm around the pieces
constexpr double scale_strip = 20;     // mm below them, for the scale bar
constexpr double scale_bar = 100;      // mm
constexpr double hairline = 0.1;       // mm
constexpr double capital_share = 0.72; // height of a capital over the font size

std::string number(double v) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", std::abs(v) < 5e-4 ? 0.0 : v);
    return text;
}

std::string escaped(const std::string& s) {
    std::string out;
    for (char c : s) {
        if (c == '&') out += "&amp;";
        else if (c == '<') out += "&lt;";
        else if (c == '>') out += "&gt;";
        else if (c == '"') out += "&quot;";
        else out += c;
    }
    return out;
}

/// From a piece's own millimetres to the page's, y down.
struct Page {
    const Nest& nest;
    double width() const { return std::max(nest.length, scale_bar) + 2 * margin; }
    double height() const { return nest.width + 2 * margin + scale_strip; }
    Vector2d operator()(int piece, const Vector2d& p) const {
        const Vector2d q = nest.placement[piece](p);
        return {q.x() + margin, nest.width + margin - q.y()};
    }
};

std::string path_data(const Page& page, int piece, const Line& line, bool closed) {
    std::string d;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const Vector2d p = page(piece, line[i]);
        d += (i == 0 ? "M" : " L") + number(p.x()) + "," + number(p.y());
    }
    return closed ? d + " Z" : d;
}

void open_layer(std::ostream& out, const char* name, const char* colour) {
    out << "<g id=\"" << name << "\" inkscape:groupmode=\"layer\" inkscape:label=\"" << name << "\" fill=\"none\" stroke=\"" << colour
        << "\" stroke-width=\"" << hairline << "\">\n";
}

/// The outline as one chain per seam side, so that a program finds matching edges again; rims or the others.
void write_sew_chains(std::ostream& out, const Page& page, int index, const PatternPiece& piece, bool rims) {
    const std::size_t n = piece.sew.size();
    std::size_t start = 0;
    while (start + 1 < n && piece.sew_seam[start] == piece.sew_seam[(start + n - 1) % n]) ++start;
    for (std::size_t i = 0; i < n;) {
        const std::size_t first = (start + i) % n;
        const SewEdge& edge = piece.sew_seam[first];
        Line chain{piece.sew[first]};
        while (i < n && piece.sew_seam[(start + i) % n] == edge) chain.push_back(piece.sew[(start + ++i) % n]);
        if (edge.rim != rims) continue;
        out << "<path id=\"" << piece.name << (rims ? "-fold-" : "-sew-") << first << "\" data-piece=\"" << piece.name << "\" data-seam=\"" << edge.seam + 1
            << "\" d=\"" << path_data(page, index, chain, false) << "\"/>\n";
    }
}

void write_text(std::ostream& out, const Vector2d& at, double height, double angle, const std::string& text, const std::string& extra) {
    out << "<text x=\"" << number(at.x()) << "\" y=\"" << number(at.y()) << "\" font-size=\"" << number(height / capital_share) << '"';
    if (std::abs(angle) > 1e-6)
        out << " transform=\"rotate(" << number(-angle * 180 / M_PI) << ' ' << number(at.x()) << ' ' << number(at.y()) << ")\"";
    out << extra << '>' << escaped(text) << "</text>\n";
}

/// A 100 mm bar under the pieces: measure it before cutting.
void write_guide(std::ostream& out, const Page& page) {
    const double x = margin, y = page.height() - margin;
    open_layer(out, "guide", "#808080");
    out << "<path id=\"scale-100mm\" d=\"M" << number(x) << ',' << number(y - 4) << " L" << number(x) << ',' << number(y) << " L" << number(x + scale_bar)
        << ',' << number(y) << " L" << number(x + scale_bar) << ',' << number(y - 4) << "\"/>\n<g fill=\"#808080\" stroke=\"none\" font-family=\"Helvetica, Arial, sans-serif\">\n";
    write_text(out, {x + 2, y - 2}, 3, 0, "100 mm", "");
    out << "</g>\n</g>\n";
}

}  // namespace

std::string piece_svg(const Pattern& pattern, std::size_t piece) {
    const Box box = bounding_box(pattern.pieces[piece].cut);
    Pattern alone;
    alone.info = pattern.info, alone.params = pattern.params;
    alone.pieces = {pattern.pieces[piece]};
    alone.info.name += "  " + pattern.pieces[piece].name;
    alone.nest.placement = {{0, -box.low}};
    alone.nest.length = box.size().x(), alone.nest.width = box.size().y();
    return pattern_svg(alone);
}

std::string pattern_svg(const Pattern& pattern) {
    const Page page{pattern.nest};
    std::ostringstream out;
    out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
           "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" width=\""
        << number(page.width()) << "mm\" height=\"" << number(page.height()) << "mm\" viewBox=\"0 0 " << number(page.width()) << ' '
        << number(page.height()) << "\">\n<title>" << escaped(pattern.info.name) << "</title>\n<desc>1 user unit = 1 mm; "
        << pattern.pieces.size() << (pattern.pieces.size() == 1 ? " piece" : " pieces") << ", seen from outside; x along the warp</desc>\n";
    const auto each = [&](const char* layer, const char* colour, auto&& body) {
        open_layer(out, layer, colour);
        for (std::size_t i = 0; i < pattern.pieces.size(); ++i) body(static_cast<int>(i), pattern.pieces[i]);
        out << "</g>\n";
    };
    const auto line = [&](int i, const Line& l, const std::string& attributes) {
        out << "<path " << attributes << " d=\"" << path_data(page, i, l, false) << "\"/>\n";
    };
    each("cut", "#ff0000", [&](int i, const PatternPiece& p) {
        out << "<path id=\"" << p.name << "-cut\" data-piece=\"" << p.name << "\" d=\"" << path_data(page, i, p.cut, true) << "\"/>\n";
    });
    each("sew", "#0000ff", [&](int i, const PatternPiece& p) { write_sew_chains(out, page, i, p, false); });
    each("fold", "#0000ff", [&](int i, const PatternPiece& p) { write_sew_chains(out, page, i, p, true); });
    each("notch", "#00aa00", [&](int i, const PatternPiece& p) {
        for (const NotchMark& notch : p.notches)
            for (const Line& stroke : notch.strokes)
                line(i, stroke, "data-piece=\"" + p.name + "\" data-seam=\"" + std::to_string(notch.seam + 1) + "\"");
    });
    each("grain", "#0000ff", [&](int i, const PatternPiece& p) {
        line(i, {p.grain[0], p.grain[1]}, "id=\"" + p.name + "-grain\" data-piece=\"" + p.name + "\"");
        for (const Line& head : grain_heads(p)) line(i, head, "data-piece=\"" + p.name + "\"");
    });
    if (pattern.params.text == Lettering::paths) {
        each("label", "#000000", [&](int i, const PatternPiece& p) {
            for (const TextMark& t : p.texts) {
                std::string d;
                for (const Line& stroke : text_strokes(t)) d += (d.empty() ? "" : " ") + path_data(page, i, stroke, false);
                out << "<path data-piece=\"" << p.name << "\" data-text=\"" << escaped(t.text) << "\" d=\"" << d << "\"/>\n";
            }
        });
    } else {
        out << "<g id=\"label\" inkscape:groupmode=\"layer\" inkscape:label=\"label\" fill=\"#000000\" stroke=\"none\" text-anchor=\"middle\" "
               "font-family=\"Helvetica, Arial, sans-serif\">\n";
        for (std::size_t i = 0; i < pattern.pieces.size(); ++i)
            for (const TextMark& t : pattern.pieces[i].texts)
                write_text(out, page(static_cast<int>(i), t.at), t.height, t.angle + pattern.nest.placement[i].turn(), t.text,
                           " data-piece=\"" + pattern.pieces[i].name + "\"");
        out << "</g>\n";
    }
    write_guide(out, page);
    out << "</svg>\n";
    return out.str();
}

}  // namespace formwork
