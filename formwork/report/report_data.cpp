#include "formwork/report/report_data.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "formwork/panels/panel_set.hpp"
#include "formwork/report/base64.hpp"
#include "formwork/report/report_fields.hpp"
#include "formwork/report/surface_lines.hpp"

namespace formwork {
namespace {

using json = nlohmann::ordered_json;  // figures keep the order in which the stages wrote them

std::string css(const Rgb& c) {
    char text[16];
    const auto part = [](double v) {
        return static_cast<int>(std::lround(255 * std::clamp(v, 0.0, 1.0)));
    };
    std::snprintf(text, sizeof text, "#%02x%02x%02x", part(c.r), part(c.g), part(c.b));
    return text;
}

/// Numbers in 65534 steps between their ends; the last step says "no value".
json quantised(const std::vector<double>& values) {
    double low = 1e300, high = -1e300;
    for (const double v : values)
        if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
    if (!(high >= low)) low = high = 0;
    std::vector<std::uint16_t> steps;
    steps.reserve(values.size());
    for (const double v : values)
        steps.push_back(!std::isfinite(v)
                            ? 65535
                            : static_cast<std::uint16_t>(
                                  std::lround(high > low ? 65534 * (v - low) / (high - low) : 0)));
    return {{"type", "steps"}, {"low", low}, {"high", high}, {"data", base64(steps)}};
}

template <class T>
json integers(const std::vector<T>& values, const char* type) {
    return {{"type", type}, {"data", base64(values)}};
}

json positions(const std::vector<Vector3d>& x) {
    json axes = json::array();
    for (int k = 0; k < 3; ++k) {
        std::vector<double> v;
        for (const Vector3d& p : x) v.push_back(p[k]);
        axes.push_back(quantised(v));
    }
    return axes;
}

/// Arms of the cross field on faces spread over the bag, as parts of their face's first two edges,
/// so that they follow every shape: arm k is parts[2k] (x1 - x0) + parts[2k + 1] (x2 - x0), two
/// arms a face.
json crosses(const Segmentation& g) {
    constexpr int count = 1800;
    const double spacing = std::sqrt(0.7 * arcsim::total_area(g.mesh) / count);
    std::vector<std::uint32_t> faces;
    std::vector<float> parts;
    for (const int f : spread_faces(g.mesh, spacing)) {
        const arcsim::FaceFrame frame = arcsim::face_frame(g.mesh, f);
        const arcsim::Triangle& t = g.mesh.faces[f];
        arcsim::Matrix2d edges;
        edges << frame.local(g.mesh.x[t[1]] - g.mesh.x[t[0]]),
            frame.local(g.mesh.x[t[2]] - g.mesh.x[t[0]]);
        faces.push_back(static_cast<std::uint32_t>(f));
        for (const double turn : {0.0, M_PI / 2}) {
            const double angle = g.field_theta[f] + turn;
            const Vector2d part =
                edges.inverse() * (0.46 * spacing * Vector2d(std::cos(angle), std::sin(angle)));
            parts.push_back(static_cast<float>(part.x()));
            parts.push_back(static_cast<float>(part.y()));
        }
    }
    return {{"faces", integers(faces, "u32")}, {"parts", integers(parts, "f32")}};
}

/// As the sheets print it (panels/panel_set.hpp), which here may not have been made yet.
std::string seam_name(const Seam& s, int number) {
    return (s.is_rim() ? "R" : "S") + std::string(number < 9 ? "0" : "") +
           std::to_string(number + 1);
}

json mesh(const ReportInput& in, const ReportMesh& m) {
    std::vector<std::uint32_t> corners;
    for (const arcsim::Triangle& t : m.rest.faces)
        corners.insert(corners.end(),
                       {static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                        static_cast<std::uint32_t>(t[2])});
    json shapes = json::array();
    for (const ReportShape& s : m.shapes)
        shapes.push_back({{"key", s.key}, {"name", s.name}, {"x", positions(s.x)}});
    json out{{"faces", integers(corners, "u32")}, {"shapes", shapes}};
    if (!in.segmentation) return out;

    const Segmentation& g = *in.segmentation;
    std::vector<std::uint16_t> panel;
    for (const int p : g.panel) panel.push_back(static_cast<std::uint16_t>(p));
    out["panel"] = integers(panel, "u16");
    if (!g.field_theta.empty()) out["crosses"] = crosses(g);
    out["label_faces"] = panel_label_faces(g, m.rest);
    out["seams"] = json::array();
    for (const Seam& s : g.seams) {
        double length = 0;
        for (size_t i = 0; i + 1 < s.nodes.size(); ++i)
            length += (g.mesh.x[s.nodes[i]] - g.mesh.x[s.nodes[i + 1]]).norm();
        out["seams"].push_back({{"name", seam_name(s, static_cast<int>(out["seams"].size()))},
                                {"nodes", s.nodes},
                                {"panels", s.panel},
                                {"length", length}});
    }
    out["singularities"] = json::array();
    for (const Singularity& s : g.singularities)
        out["singularities"].push_back({{"node", s.node}, {"index4", s.index4}});
    return out;
}

json fields(const std::vector<ReportField>& all) {
    json out = json::array();
    for (const ReportField& f : all)
        out.push_back({{"key", f.key},
                       {"of", f.of},
                       {"title", f.scale.title},
                       {"unit", f.scale.unit},
                       {"map", f.scale.map == ColourMap::sequential ? "sequential" : "diverging"},
                       {"low", f.scale.low},
                       {"high", f.scale.high},
                       {"per_node", f.per_node},
                       {"classes", f.classes},
                       {"values", quantised(f.values)}});
    return out;
}

json colour_maps() {
    json out;
    for (const auto& [name, map] :
         {std::pair{"sequential", ColourMap::sequential}, {"diverging", ColourMap::diverging}}) {
        std::string bytes;
        for (int i = 0; i < 256; ++i) {
            const Rgb c = map_colour(map, i / 255.0);
            for (const double v : {c.r, c.g, c.b}) bytes += static_cast<char>(std::lround(255 * v));
        }
        out[name] = base64(std::string_view(bytes));
    }
    return out;
}

json panels(const ReportInput& in) {
    json out = json::array();
    const std::vector<Rgb> colours =
        in.segmentation ? panel_colours(*in.segmentation) : std::vector<Rgb>();
    for (const FlatPanel& p : in.panels) {
        json outline = json::array();
        for (const int i : p.boundary)  // mm, to the hundredth
            outline.push_back(
                {std::round(1e5 * p.u[i].x()) / 100, std::round(1e5 * p.u[i].y()) / 100});
        const bool known = p.id >= 0 && p.id < static_cast<int>(colours.size());
        out.push_back({{"id", p.id},
                       {"name", panel_name(p.id)},
                       {"colour", css(known ? colours[p.id] : class_colour(p.id))},
                       {"outline", outline},
                       {"area", p.area},
                       {"rest_area", p.rest_area},
                       {"max_distortion", p.max_stretch_distortion},
                       {"mean_distortion", p.mean_stretch_distortion},
                       {"grain_deviation_deg", p.grain_deviation_deg},
                       {"flips", p.flips},
                       {"overlaps", p.overlaps}});
    }
    if (in.panels.empty())
        for (size_t p = 0; p < colours.size(); ++p)
            out.push_back({{"id", p},
                           {"name", panel_name(static_cast<int>(p))},
                           {"colour", css(colours[p])}});
    return out;
}

json parsed(const std::string& text) {
    if (text.empty()) return nullptr;
    const json value = json::parse(text, nullptr, false, true);
    return value.is_discarded() ? json(text) : value;
}

}  // namespace

std::string report_data(const ReportInput& in) {
    const ReportMesh m = report_mesh(in);
    json out{{"title", in.title},
             {"version", FORMWORK_VERSION},
             {"up", {in.up.x(), in.up.y(), in.up.z()}},
             {"summary", parsed(in.summary_json)},
             {"scene", parsed(in.scene_json)},
             {"maps", colour_maps()},
             {"mesh", mesh(in, m)},
             {"fields", fields(report_fields(in))},
             {"panels", panels(in)},
             {"notes", in.notes}};
    out["sewing"] = json::array();
    for (const ReportStep& s : in.sewing_order)
        out["sewing"].push_back({{"text", s.text}, {"seam", s.seam}, {"panels", s.panels}});
    out["convergence"] = json::array();
    for (const ConvergenceCurve& c : in.convergence)
        out["convergence"].push_back({{"name", c.name}, {"residual", c.residual}});
    out["pictures"] = json::array();
    for (const ReportPicture& p : in.pictures)
        out["pictures"].push_back(
            {{"title", p.title}, {"caption", p.caption}, {"png", base64(std::string_view(p.png))}});
    return out.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace formwork
