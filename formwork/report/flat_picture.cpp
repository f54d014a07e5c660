#include <algorithm>
#include <cmath>
#include <cstdio>

#include "formwork/panels/panel_set.hpp"
#include "formwork/report/camera.hpp"
#include "formwork/report/legend.hpp"
#include "formwork/report/paint.hpp"
#include "formwork/report/pictures.hpp"
#include "formwork/report/raster.hpp"
#include "formwork/report/stroke_font.hpp"

namespace formwork {
namespace {

struct Box {
    double x0 = 1e300, y0 = 1e300, x1 = -1e300, y1 = -1e300;
    double width() const { return x1 - x0; }
    double height() const { return y1 - y0; }
};

/// A place on the sheet for a panel's box, m; y grows downwards.
struct Place {
    double x = 0, y = 0;
};

Vector2d drawn(const Vector2d& u) {
    return {-u.y(), -u.x()};
}  // warp upwards, seen from outside; y down

Box bounds(const FlatPanel& p) {
    Box b;
    for (const Vector2d& u : p.u) {
        const Vector2d q = drawn(u);
        b.x0 = std::min(b.x0, q.x()), b.x1 = std::max(b.x1, q.x());
        b.y0 = std::min(b.y0, q.y()), b.y1 = std::max(b.y1, q.y());
    }
    if (p.u.empty()) b = {0, 0, 0, 0};
    return b;
}

/// Rows of boxes no wider than `width`; returns the height used.
double place_rows(const std::vector<Box>& boxes, double width, double gap,
                  std::vector<Place>& places) {
    places.assign(boxes.size(), {});
    double x = 0, y = 0, row = 0;
    for (size_t i = 0; i < boxes.size(); ++i) {
        if (x > 0 && x + boxes[i].width() > width) x = 0, y += row + gap, row = 0;
        places[i] = {x, y};
        x += boxes[i].width() + gap;
        row = std::max(row, boxes[i].height());
    }
    return y + row;
}

void fill_panel(Raster& raster, const FlatPanel& p, const Box& b, const Place& at, double scale,
                const Rgb& colour, double x0, double y0) {
    std::vector<Projected> q;
    for (const Vector2d& u : p.u) {
        const Vector2d d = drawn(u);
        q.push_back({x0 + scale * (at.x + d.x() - b.x0), y0 + scale * (at.y + d.y() - b.y0), 1});
    }
    const auto corner = [&](int i) { return RasterVertex{q[i], Vector3d::UnitZ(), colour}; };
    for (const Triangle& t : p.faces)
        raster.flat_triangle(corner(t[0]), corner(t[1]), corner(t[2]));
    for (size_t i = 0; i < p.boundary.size(); ++i) {
        Projected a = q[p.boundary[i]], c = q[p.boundary[(i + 1) % p.boundary.size()]];
        a.nearness = c.nearness = 2;
        raster.stroke(a, c, 2.4, {0.07, 0.08, 0.1}, 1);
    }
}

/// The middle of the face farthest from the outline; in a strip, the one nearest to the piece's
/// middle.
Vector2d label_point(const FlatPanel& p) {
    Vector2d middle = Vector2d::Zero(), best = Vector2d::Zero();
    for (const Vector2d& u : p.u) middle += u / p.u.size();
    double depth = -1e300;
    for (const Triangle& t : p.faces) {
        const Vector2d c = (p.u[t[0]] + p.u[t[1]] + p.u[t[2]]) / 3;
        double nearest = 1e300;
        for (const int i : p.boundary) nearest = std::min(nearest, (p.u[i] - c).squaredNorm());
        const double d = std::sqrt(nearest) - 0.2 * (c - middle).norm();
        if (d > depth) depth = d, best = c;
    }
    return best;
}

void draw_arrow(Image& image, double x, double y, double length) {
    const Rgb ink{0.07, 0.08, 0.1};
    draw_line(image, x, y + length / 2, x, y - length / 2, 2, ink);
    draw_line(image, x, y - length / 2, x - 5, y - length / 2 + 8, 2, ink);
    draw_line(image, x, y - length / 2, x + 5, y - length / 2 + 8, 2, ink);
}

void draw_scale_bar(Image& image, double scale, double x, double y) {
    const std::vector<double> lengths = round_ticks(0, 180 / scale, 2);
    const double length = lengths.size() > 1 ? lengths[1] : lengths[0];
    const double px = length * scale;
    const Rgb ink{0.13, 0.14, 0.16};
    draw_line(image, x, y, x + px, y, 2, ink);
    for (const double e : {x, x + px}) draw_line(image, e, y - 6, e, y + 6, 2, ink);
    char text[64];
    std::snprintf(text, sizeof text, "%.4g mm, warp upwards, seen from outside", 1000 * length);
    draw_text(image, x + px + 16, y + 6, text, {.size_px = 18});
}

}  // namespace

Image picture_flat_panels(const Segmentation& segmentation, const std::vector<FlatPanel>& panels,
                          const std::string& title) {
    PictureOptions o;
    std::vector<Box> boxes;
    double area = 0, longest = 0;
    for (const FlatPanel& p : panels) {
        boxes.push_back(bounds(p));
        area += boxes.back().width() * boxes.back().height();
        longest = std::max({longest, boxes.back().width(), boxes.back().height()});
    }
    if (panels.empty() || !(area > 0)) return Image(o.width, o.height);

    // The width of the rows that gives the largest common scale.
    const double x0 = 40, y0 = 118, room_x = o.width - 2 * x0, room_y = o.height - y0 - 90,
                 gap = 0.06 * longest;
    std::vector<Place> places, trial;
    double scale = 0, sheet_height = 0, sheet_width = 0;
    for (int k = 0; k < 60; ++k) {
        const double width = std::sqrt(area) * (0.5 + 0.05 * k);
        const double height = place_rows(boxes, width, gap, trial);
        double used = 0;
        for (size_t i = 0; i < boxes.size(); ++i)
            used = std::max(used, trial[i].x + boxes[i].width());
        const double s = std::min(room_x / used, room_y / height);
        if (s > scale)
            scale = s, places = trial, sheet_height = scale * height, sheet_width = scale * used;
    }
    const double least = 560;  // room for the heading and the scale bar
    Image image(static_cast<int>(std::ceil(std::max(least, sheet_width + 2 * x0))),
                static_cast<int>(std::ceil(y0 + sheet_height + 90)));
    const std::vector<Rgb> colours = panel_colours(segmentation);
    Raster raster(image.width, image.height);
    for (size_t i = 0; i < panels.size(); ++i) {
        const size_t id = static_cast<size_t>(panels[i].id);
        const Rgb c = id < colours.size() ? colours[id] : class_colour(panels[i].id);
        fill_panel(raster, panels[i], boxes[i], places[i], scale, mix(c, {1, 1, 1}, 0.3), x0, y0);
    }
    raster.resolve(image, 0);
    double distortion = 0;
    for (size_t i = 0; i < panels.size(); ++i) {
        const Vector2d d = drawn(label_point(panels[i]));
        const double x = x0 + scale * (places[i].x + d.x() - boxes[i].x0),
                     y = y0 + scale * (places[i].y + d.y() - boxes[i].y0);
        const double size =
            std::clamp(0.28 * scale * std::min(boxes[i].width(), boxes[i].height()), 9.0, 24.0);
        const double arrow = std::clamp(0.3 * scale * boxes[i].height(), 10.0, 4 * size);
        draw_arrow(image, x, y - 0.6 * size, arrow);
        draw_text(image, x, y + arrow / 2 + 0.55 * size, panel_name(panels[i].id),
                  {.size_px = size, .weight = 1.3, .anchor = Anchor::middle, .halo_px = 1.5});
        distortion = std::max(distortion, panels[i].max_stretch_distortion);
    }
    draw_scale_bar(image, scale, x0, image.height - 38);
    char note[120];
    std::snprintf(note, sizeof note, "%zu pieces, largest distortion of the flattening %.2g %%",
                  panels.size(), 100 * distortion);
    draw_heading(image, title, note);
    return image;
}

}  // namespace formwork
