#include "formwork/report/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "formwork/report/surface_lines.hpp"

namespace formwork {
namespace {

PictureOptions options(const Vector3d& up, const std::string& title, const std::string& note = {}) {
    PictureOptions o;
    o.up = up;
    o.title = title;
    o.note = note;
    return o;
}

template <class Member>
std::vector<double> per_face(const StrainField& strain, Member member) {
    std::vector<double> v;
    v.reserve(strain.size());
    for (const FaceStrain& s : strain) v.push_back(member(s));
    return v;
}

std::string range_note(const std::vector<double>& v, const char* name, const char* unit) {
    if (v.empty()) return {};
    const auto [lo, hi] = std::minmax_element(v.begin(), v.end());
    char text[120];
    std::snprintf(text, sizeof text, "%s from %.4g to %.4g %s", name, *lo, *hi, unit);
    std::string note = text;  // a minus sign instead of a hyphen before digits
    for (size_t i = 0; (i = note.find(" -", i)) != std::string::npos; i += 2)
        note.replace(i, 2, " \u2212");
    return note;
}

}  // namespace

Image picture_stretch(const Surface& shown, const StrainField& strain, const Vector3d& up,
                      const std::string& title) {
    const std::vector<double> v = per_face(strain, [](const FaceStrain& s) { return s.lambda1; });
    return render_surface(shown,
                          paint_values(v, false, sequential_scale(v, "stretch \u03bb\u2081", "-")),
                          {}, {}, options(up, title, range_note(v, "\u03bb\u2081", "")));
}

Image picture_tension(const Surface& shown, const StrainField& strain, const Vector3d& up,
                      const std::string& title) {
    const std::vector<double> v = per_face(strain, [](const FaceStrain& s) { return s.tension1; });
    return render_surface(shown, paint_values(v, false, sequential_scale(v, "tension", "N/m")), {},
                          {},
                          options(up, title, range_note(v, "largest principal tension", "N/m")));
}

Image picture_shear(const Surface& shown, const StrainField& strain, const Vector3d& up,
                    const std::string& title) {
    const std::vector<double> v =
        per_face(strain, [](const FaceStrain& s) { return std::abs(s.eps_uv); });
    return render_surface(
        shown, paint_values(v, false, sequential_scale(v, "shear |\u03b5_uv|", "-")), {}, {},
        options(up, title, range_note(v, "|\u03b5_uv|", "in the weave frame")));
}

Image picture_states(const Surface& shown, const StrainField& strain, const Vector3d& up,
                     const std::string& title) {
    std::vector<int> state;
    int count[3] = {0, 0, 0};
    for (const FaceStrain& s : strain)
        state.push_back(static_cast<int>(s.state)), ++count[static_cast<int>(s.state)];
    const std::vector<Swatch> classes{
        {{0.72, 0.78, 0.84}, "taut"}, {class_colour(0), "wrinkled"}, {class_colour(5), "slack"}};
    char note[120];
    std::snprintf(note, sizeof note, "%d faces taut, %d wrinkled, %d slack", count[0], count[1],
                  count[2]);
    return render_surface(shown, paint_classes(state, classes, "state"), {}, {},
                          options(up, title, note));
}

Image picture_deviation(const Surface& shown, const std::vector<double>& distance,
                        const Vector3d& up, const std::string& title) {
    std::vector<double> mm;
    for (const double d : distance) mm.push_back(1000 * d);
    return render_surface(
        shown, paint_values(mm, true, diverging_scale(mm, "deviation", "mm")), {}, {},
        options(up, title, range_note(mm, "signed distance", "mm; positive is outside")));
}

Image picture_seam_forces(const Surface& shown, const std::vector<SeamEdgeForce>& seams,
                          const Vector3d& up, const std::string& title) {
    std::vector<double> force;
    for (const SeamEdgeForce& s : seams) force.push_back(s.force_N);
    const bool pushes = std::any_of(force.begin(), force.end(), [](double f) { return f < 0; });
    const char* name = "force of the thread";
    Paint paint = paint_plain();
    paint.bar = pushes ? diverging_scale(force, name, "N") : sequential_scale(force, name, "N");
    std::vector<Line3> lines;
    for (const SeamEdgeForce& s : seams) {
        const double at = (s.force_N - paint.bar->low) / (paint.bar->high - paint.bar->low);
        lines.push_back({{shown.x[s.node[0]], shown.x[s.node[1]]}, map_colour(paint.bar->map, at), 6});
    }
    return render_surface(shown, paint, lines, {},
                          options(up, title, range_note(force, "force", "N; below 0 it pushes")));
}

Image picture_cross_field(const Surface& shown, const std::vector<double>& theta,
                          const std::vector<DirectionData>& data,
                          const std::vector<Singularity>& singularities, const Vector3d& up,
                          const std::string& title) {
    std::vector<double> weight(theta.size(), 0.0);
    for (size_t f = 0; f < data.size() && f < weight.size(); ++f) weight[f] = data[f].weight;
    Paint paint = paint_plain();
    if (!data.empty()) {
        paint =
            paint_values(weight, false, {ColourMap::sequential, 0, 1, "weight of the data", "-"});
        paint.dim = 0.45;
    }
    return render_surface(shown, paint, cross_lines(shown, theta, 1600),
                          singularity_marks(shown, singularities),
                          options(up, title, singularity_note(singularities)));
}

Image picture_curves(const Surface& shown, const std::vector<std::vector<Vector3d>>& candidates,
                     const std::vector<std::vector<Vector3d>>& chosen,
                     const std::vector<Singularity>& singularities, const Vector3d& up,
                     const std::string& title) {
    std::vector<Line3> lines;
    for (const auto& c : candidates) lines.push_back({c, {0.25, 0.45, 0.7}, 1.6, 0.75});
    for (const auto& c : chosen) lines.push_back({c, {0.75, 0.15, 0.05}, 4.0, 1});
    char note[120];
    if (candidates.empty()) std::snprintf(note, sizeof note, "%zu seams", chosen.size());
    else std::snprintf(note, sizeof note, "%zu candidate curves, %zu chosen", candidates.size(), chosen.size());
    return render_surface(shown, paint_plain(), lines, singularity_marks(shown, singularities),
                          options(up, title, note));
}

Image picture_panels(const Segmentation& segmentation, const Surface& shown, const Vector3d& up,
                     const std::string& title) {
    const std::vector<Rgb> colours = panel_colours(segmentation);
    Paint paint;
    for (const int p : segmentation.panel) paint.colour.push_back(colours[p]);
    paint.dim = 0.15;
    char note[120];
    const size_t n_seams = std::count_if(segmentation.seams.begin(), segmentation.seams.end(),
                                         [](const Seam& s) { return !s.is_rim(); });
    std::snprintf(note, sizeof note, "%d panels, %zu seams", segmentation.n_panels, n_seams);
    return render_surface(shown, paint, seam_lines(segmentation, shown),
                          panel_name_marks(segmentation, shown), options(up, title, note));
}

std::vector<Rgb> panel_colours(const Segmentation& segmentation) {
    std::vector<std::vector<int>> neighbours(segmentation.n_panels);
    for (const Seam& s : segmentation.seams) {
        if (s.is_rim() || s.panel[0] == s.panel[1]) continue;
        neighbours[s.panel[0]].push_back(s.panel[1]);
        neighbours[s.panel[1]].push_back(s.panel[0]);
    }
    std::vector<Rgb> colours;
    for (const int c : colour_classes(neighbours)) colours.push_back(class_colour(c));
    return colours;
}

}  // namespace formwork
