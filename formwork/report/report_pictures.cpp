#include "formwork/report/report_pictures.hpp"

#include <algorithm>
#include <functional>
#include <future>

#include "formwork/report/pictures.hpp"

namespace formwork {
namespace {

/// A picture that is still to be drawn.
struct Task {
    std::string name, title, caption;
    std::function<Image(const std::string& title)> draw;
};

bool any_not_taut(const StrainField& strain) {
    return std::any_of(strain.begin(), strain.end(),
                       [](const FaceStrain& s) { return s.state != FaceState::taut; });
}

void add_inflated(std::vector<Task>& tasks, const ReportInput& in) {
    if (in.inflated.empty() || in.inflated_strain.empty()) return;
    const Surface shown{in.inflated, in.rest.faces};
    tasks.push_back({"inflated_stretch", "Inflated bag: stretch",
                     "Largest principal stretch of the inflated bag.",
                     [=, &in](const std::string& t) {
                         return picture_stretch(shown, in.inflated_strain, in.up, t);
                     }});
    tasks.push_back({"inflated_tension", "Inflated bag: tension",
                     "Largest principal tension of the inflated bag, per rest width.",
                     [=, &in](const std::string& t) {
                         return picture_tension(shown, in.inflated_strain, in.up, t);
                     }});
    if (any_not_taut(in.inflated_strain))
        tasks.push_back({"inflated_wrinkles", "Inflated bag: wrinkles",
                         "Where the fabric is taut, wrinkled or slack.",
                         [=, &in](const std::string& t) {
                             return picture_states(shown, in.inflated_strain, in.up, t);
                         }});
}

std::vector<std::vector<Vector3d>> chains(const Segmentation& g) {
    std::vector<std::vector<Vector3d>> out;
    for (const Seam& s : g.seams) {
        if (s.is_rim()) continue;
        out.emplace_back();
        for (const int i : s.nodes) out.back().push_back(g.mesh.x[i]);
    }
    return out;
}

void add_segmentation(std::vector<Task>& tasks, const ReportInput& in) {
    if (!in.segmentation) return;
    const Segmentation& g = *in.segmentation;
    if (g.direction.size() == g.mesh.faces.size())
        tasks.push_back({"field_raw", "What the strain asks for",
                         "Directions of the strain, before smoothing, and how much they weigh.",
                         [&](const std::string& t) {
                             std::vector<double> theta;
                             for (const DirectionData& d : g.direction) theta.push_back(d.theta);
                             return picture_cross_field(g.mesh, theta, g.direction, {}, in.up, t);
                         }});
    if (g.field_theta.size() == g.mesh.faces.size())
        tasks.push_back({"field_smooth", "Smoothed cross field",
                         "The smoothed cross field with its singularities, marked by valence.",
                         [&](const std::string& t) {
                             return picture_cross_field(g.mesh, g.field_theta, g.direction,
                                                        g.singularities, in.up, t);
                         }});
    tasks.push_back(
        {"seams", "Seams",
         in.candidates.empty() ? "The seams." : "All candidate curves, and the chosen seams.",
         [&](const std::string& t) {
             return picture_curves(g.mesh, in.candidates, chains(g), g.singularities, in.up, t);
         }});
    tasks.push_back({"panels_on_bag", "Panels on the bag", "The panels on the surface that is cut.",
                     [&](const std::string& t) { return picture_panels(g, g.mesh, in.up, t); }});
    if (!in.panels.empty())
        tasks.push_back(
            {"panels_flat", "Flat panels",
             "The pieces, flat, at one scale; the files to cut from are in the panels folder.",
             [&](const std::string& t) { return picture_flat_panels(g, in.panels, t); }});
}

void add_sewn(std::vector<Task>& tasks, const ReportInput& in) {
    if (in.sewn.empty() || !in.segmentation) return;
    const Segmentation& g = *in.segmentation;
    const Surface shown{in.sewn, g.mesh.faces};
    tasks.push_back(
        {"sewn_panels", "Sewn bag", "The sewn bag, filled, with its panels.",
         [=, &in, &g](const std::string& t) { return picture_panels(g, shown, in.up, t); }});
    if (!in.sewn_strain.empty()) {
        tasks.push_back({"sewn_shear", "Sewn bag: shear of the weave",
                         "Shear between warp and weft of the sewn bag.",
                         [=, &in](const std::string& t) {
                             return picture_shear(shown, in.sewn_strain, in.up, t);
                         }});
        tasks.push_back({"sewn_tension", "Sewn bag: tension",
                         "Largest principal tension of the sewn bag, per rest width.",
                         [=, &in](const std::string& t) {
                             return picture_tension(shown, in.sewn_strain, in.up, t);
                         }});
        if (any_not_taut(in.sewn_strain))
            tasks.push_back({"sewn_wrinkles", "Sewn bag: wrinkles",
                             "Where the sewn fabric is taut, wrinkled or slack.",
                             [=, &in](const std::string& t) {
                                 return picture_states(shown, in.sewn_strain, in.up, t);
                             }});
    }
    if (!in.seam_forces.empty())
        tasks.push_back({"sewn_seams", "Sewn bag: forces of the seams",
                         "Tension of the seams' threads in the filled bag.",
                         [=, &in](const std::string& t) {
                             return picture_seam_forces(shown, in.seam_forces, in.up, t);
                         }});
    if (!in.deviation.empty())
        tasks.push_back({"sewn_deviation", "Sewn bag: deviation",
                         "Signed distance of the sewn bag from " + in.deviation_from + ".",
                         [=, &in](const std::string& t) {
                             return picture_deviation(shown, in.deviation, in.up, t);
                         }});
}

}  // namespace

std::vector<ReportPicture> draw_pictures(const ReportInput& in, int threads) {
    std::vector<Task> tasks;
    add_inflated(tasks, in);
    add_segmentation(tasks, in);
    add_sewn(tasks, in);
    std::vector<ReportPicture> pictures(tasks.size());
    const int n = std::max(1, std::min(threads, static_cast<int>(tasks.size())));
    std::vector<std::future<void>> workers;  // pictures are independent: every n-th to each
    for (int w = 0; w < n; ++w)
        workers.push_back(std::async(n > 1 ? std::launch::async : std::launch::deferred, [&, w] {
            for (size_t i = w; i < tasks.size(); i += n)
                pictures[i] = {tasks[i].name, tasks[i].title, tasks[i].caption,
                               encode_png(tasks[i].draw(tasks[i].title))};
        }));
    for (std::future<void>& w : workers) w.get();
    return pictures;
}

std::vector<ReportStep> report_steps(const PanelSet& set, const std::vector<SewingStep>& order) {
    std::vector<ReportStep> steps;
    const auto listed = [](const std::vector<int>& numbers, const auto& name) {
        std::string text;
        for (const int i : numbers) text += (text.empty() ? "" : ", ") + name(i);
        return text;
    };
    const auto seam = [&](int i) { return seam_name(set, i); };
    for (const SewingStep& s : order) {
        double length = 0;
        for (const int i : s.seams) length += set.seams[i].side[0].length;
        std::string what;
        const std::string first = panel_name(s.panels.front()), last = panel_name(s.panels.back());
        switch (s.kind) {
            case StepKind::dart: what = "close the dart in " + first; break;
            case StepKind::join: what = "join " + first + " to " + last; break;
            case StepKind::close: what = "close " + (first == last ? first + " on itself" : first + " to " + last); break;
            case StepKind::hem: what = "hem the rim of " + listed(s.panels, panel_name); break;
            case StepKind::opening: what = "last, the pouring opening between " + first + " and " + last; break;
        }
        if (s.kind == StepKind::hem && &s == &order.back()) what = "last, the pouring opening: " + what;
        steps.push_back({listed(s.seams, seam) + ": " + what + ", " +
                             std::to_string(static_cast<long>(1000 * length + 0.5)) + " mm",
                         s.seams.front(), s.panels});
    }
    return steps;
}

}  // namespace formwork
