#include "formwork/report/render_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "formwork/report/camera.hpp"
#include "formwork/report/legend.hpp"
#include "formwork/report/raster.hpp"
#include "formwork/report/stroke_font.hpp"

namespace formwork {
namespace {

constexpr Rgb plain_cloth{0.86, 0.87, 0.88};

/// How far lines are lifted towards the eye, in diameters: above the facets that they cut, below a
/// fold.
constexpr double line_lift = 0.004;

struct View {
    double azimuth_deg, elevation_deg;
};

std::vector<View> choose_views(const Surface& s, const PictureOptions& o) {
    Vector3d e1, e2;
    horizontal_axes(o.up, e1, e2);
    const Vector3d d = o.up.normalized();
    Vector3d lo = Vector3d::Constant(1e300), hi = -lo;
    for (const Vector3d& p : s.x) {
        const Vector3d q(p.dot(e1), p.dot(e2), p.dot(d));
        lo = lo.cwiseMin(q), hi = hi.cwiseMax(q);
    }
    const Vector3d size = hi - lo;
    const bool flat = size.z() < 0.3 * std::max(size.x(), size.y());
    const double elevation = o.elevation_deg >= -90 ? o.elevation_deg : flat ? 38 : 16;
    std::vector<double> azimuths = o.azimuths_deg;
    if (azimuths.empty()) {
        // Look across the longer side; a standing bag is shown from the front and from behind.
        const double first = size.y() > 1.3 * size.x() ? 25 : size.x() > 1.3 * size.y() ? -65 : -55;
        azimuths = flat ? std::vector<double>{first} : std::vector<double>{first, first + 180};
    }
    std::vector<View> views;
    for (const double a : azimuths) views.push_back({a, elevation});
    return views;
}

void draw_faces(Raster& raster, const Camera& camera, const Surface& s, const Paint& paint,
                const std::vector<Vector3d>& normals) {
    std::vector<Projected> at(s.x.size());
    for (size_t i = 0; i < s.x.size(); ++i) at[i] = camera.project(s.x[i]);
    for (int f = 0; f < s.n_faces(); ++f) {
        const Vector3d n = arcsim::area_vector(s, f).normalized();
        const bool inside = n.dot(camera.towards_eye(arcsim::face_centroid(s, f))) < 0;
        RasterVertex v[3];
        for (int k = 0; k < 3; ++k) {
            const int i = s.faces[f][k];
            // A corner whose smooth normal leaves the face far (a crease) is shaded with the face's
            // own.
            const Vector3d m = normals[i].dot(n) > 0.6 ? normals[i] : n;
            const Rgb c = paint.colour.empty() ? plain_cloth : paint.colour[paint.per_node ? i : f];
            v[k] = {at[i], camera.to_view(m), mix(c, {1, 1, 1}, paint.dim)};
        }
        raster.triangle(v[0], v[1], v[2], inside);
    }
}

void draw_lines(Raster& raster, const Camera& camera, const std::vector<Line3>& lines) {
    constexpr double edge_on = 0.25;
    for (const Line3& line : lines) {
        if (!line.points.empty() && line.normal.norm() > 0 &&
            std::abs(line.normal.dot(camera.towards_eye(line.points[0]))) < edge_on)
            continue;
        for (size_t i = 0; i + 1 < line.points.size(); ++i) {
            Projected a = camera.project(line.points[i]), b = camera.project(line.points[i + 1]);
            a.nearness = camera.nearness_step(a.nearness, line_lift * camera.diameter());
            b.nearness = camera.nearness_step(b.nearness, line_lift * camera.diameter());
            raster.stroke(a, b, line.width_px, line.colour, line.opacity);
        }
    }
}

/// The marks that can be seen, farthest first, so that near ones lie on top; one per group.
std::vector<std::pair<Projected, const Mark3*>> visible_marks(const Raster& raster,
                                                              const Camera& camera,
                                                              const std::vector<Mark3>& marks) {
    std::vector<std::pair<Projected, const Mark3*>> seen;
    std::map<int, std::pair<double, size_t>>
        best;  // of each group: how well it is seen, and where in `seen`
    for (const Mark3& m : marks) {
        Projected p = camera.project(m.at);
        p.nearness = camera.nearness_step(p.nearness, 3 * line_lift * camera.diameter());
        if (!raster.is_visible(p)) continue;
        if (m.group >= 0) {
            const double rank = m.weight * m.normal.dot(camera.towards_eye(m.at));
            constexpr double least_px =
                9;  // of room between the mark and the border of what it names
            if (rank * camera.scale() < least_px) continue;
            const auto [it, is_first] = best.try_emplace(m.group, rank, seen.size());
            if (!is_first) {
                if (rank > it->second.first)
                    it->second.first = rank, seen[it->second.second] = {p, &m};
                continue;
            }
        }
        seen.push_back({p, &m});
    }
    std::stable_sort(seen.begin(), seen.end(), [](const auto& q, const auto& r) {
        return q.first.nearness < r.first.nearness;
    });
    return seen;
}

void draw_mark(Image& image, const Projected& p, const Mark3& m) {
    const double size = m.radius_px > 0 ? std::min(22.0, 1.25 * m.radius_px) : 24;
    if (m.radius_px > 0) {
        fill_disc(image, p.x, p.y, m.radius_px + 2, {1, 1, 1});
        fill_disc(image, p.x, p.y, m.radius_px, m.colour);
        draw_text(image, p.x, p.y + 0.35 * size, m.text,
                  {.size_px = size, .weight = 1.3, .colour = {1, 1, 1}, .anchor = Anchor::middle});
    } else {
        draw_text(image, p.x, p.y + 0.35 * size, m.text,
                  {.size_px = size,
                   .weight = 1.3,
                   .colour = m.colour,
                   .anchor = Anchor::middle,
                   .halo_px = 3.5});
    }
}

}  // namespace

std::vector<Vector3d> node_normals(const Surface& s) {
    std::vector<Vector3d> n(s.x.size(), Vector3d::Zero());
    for (int f = 0; f < s.n_faces(); ++f)
        for (const int i : s.faces[f]) n[i] += arcsim::area_vector(s, f);
    for (Vector3d& v : n)
        if (v.norm() > 0) v.normalize();
    return n;
}

Image render_surface(const Surface& surface, const Paint& paint, const std::vector<Line3>& lines,
                     const std::vector<Mark3>& marks, const PictureOptions& options) {
    const size_t expected = paint.per_node ? surface.x.size() : surface.faces.size();
    if (!paint.colour.empty() && paint.colour.size() != expected)
        throw std::invalid_argument("render_surface: colours and surface differ in number");
    const std::vector<View> views = choose_views(surface, options);
    const std::vector<Vector3d> normals = node_normals(surface);
    const double legend = legend_width(paint), pad = 36;
    const double top = options.title.empty() && options.note.empty() ? pad
                       : options.note.empty()                        ? 80
                                                                     : 112;
    const double room = (options.width - std::max(legend, pad) - pad) / views.size() - pad;

    std::vector<Camera> cameras;
    double scale = 1e300;  // the same for all views, so that they can be compared
    for (const View& v : views) {
        cameras.emplace_back(surface.x, options.up, v.azimuth_deg, v.elevation_deg);
        scale = std::min(scale, cameras.back().fit(surface.x, 0, top, room, options.height - pad));
    }
    double x = pad;
    for (Camera& camera : cameras) {
        const double width = camera.rescale(scale, x);
        x += width + 1.5 * pad;
    }
    const double heading = heading_width(options.title, options.note);
    const int width =
        static_cast<int>(std::ceil(std::max(x - 1.5 * pad + std::max(legend, pad), heading + pad)));
    Image image(width, options.height);
    Raster raster(width, options.height);
    for (const Camera& camera : cameras) draw_faces(raster, camera, surface, paint, normals);
    std::vector<std::pair<Projected, const Mark3*>>
        seen;  // before the lines, which would hide them
    for (const Camera& camera : cameras) {
        const auto in_view = visible_marks(raster, camera, marks);
        seen.insert(seen.end(), in_view.begin(), in_view.end());
    }
    for (const Camera& camera : cameras) draw_lines(raster, camera, lines);
    raster.resolve(image, 0.05 * options.height);
    for (const auto& [at, mark] : seen) draw_mark(image, at, *mark);
    draw_legend(image, paint, width - legend, top, options.height - pad);
    draw_heading(image, options.title, options.note);
    return image;
}

}  // namespace formwork
