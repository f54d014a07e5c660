#include <cstdio>
#include <memory>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/cli/session.hpp"
#include "formwork/scene/formwork_scene.hpp"
#include "formwork/stages/summary.hpp"
#include "formwork/study/study_files.hpp"

namespace formwork {

using arcsim::format_short;

namespace {

struct Study {
    FormworkScene scene;
    std::filesystem::path dir;
};

Study open(const SceneArguments& a, arcsim::Progress& progress) {
    Study s{read_scene(a.scene, {a.overrides, a.threads, a.ignore_unsupported}), {}};
    s.dir = a.out.empty() ? std::filesystem::path("out") / s.scene.name() : std::filesystem::path(a.out);
    for (const std::string& warning : s.scene.warnings) progress.warning(warning);
    return s;
}

void finish(const Study& s, const char* name, arcsim::JsonValue figures) {
    arcsim::write_file_atomically(s.dir / "scene.json", effective_scene_text(s.scene, s.dir));
    arcsim::JsonValue summary = read_summary(s.dir);
    summary.set(name, std::move(figures));
    write_summary(s.dir, summary);
}

void tensile(const SceneArguments& a, Session& session) {
    arcsim::Progress progress(session.verbosity());
    progress.begin("tensile");
    const Study s = open(a, progress);
    if (!s.scene.formwork.tensile)
        throw arcsim::InputError(s.scene.source + ": /formwork/tensile is missing. Add \"tensile\": {\"material\": {\"model\": \"tensor\", \"data\": \"woven.json\"}}.");
    const TensileParams& p = *s.scene.formwork.tensile;
    const std::vector<TensileCurve> curves = run_tensile(p, [&](int done, int all) {
        progress.update({done, -1, -1, static_cast<double>(done) / all, "point " + std::to_string(done) + " of " + std::to_string(all)});
    });
    finish(s, "tensile", write_tensile(s.dir, curves, p.measured.has_value()));
    progress.end("tensile: " + std::to_string(curves.size()) + " strips, " + (s.dir / "tensile/tensile.png").string());
    if (session.quiet) return;
    for (const TensileCurve& c : curves)
        if (!c.points.empty())
            std::printf("  %5.1f degrees: %s N at %s mm%s\n", c.angle_deg, format_short(c.points.back().force_N, 6).c_str(),
                        format_short(c.points.back().displacement_mm).c_str(),
                        c.misfit >= 0 ? (", misfit " + format_short(100 * c.misfit, 3) + " %").c_str() : "");
}

void fit(const SceneArguments& a, Session& session) {
    arcsim::Progress progress(session.verbosity());
    progress.begin("fit");
    const Study s = open(a, progress);
    if (!s.scene.formwork.fit)
        throw arcsim::InputError(s.scene.source + ": /formwork/fit is missing. Add \"fit\": {\"measured\": \"curves.csv\"}.");
    const FitParams& p = *s.scene.formwork.fit;
    const std::vector<MeasuredCurve> measured = read_measured_curves(p.measured.path);
    std::unique_ptr<StripLaw> start = start_from_slopes(p, measured);
    double density = 0.2;
    if (p.initial) {
        const arcsim::MaterialData data = arcsim::read_material(p.initial->path);
        if (p.model == FitModel::tensor) {
            std::vector<double> entries;
            for (const auto& row : data.stretching) entries.insert(entries.end(), row.data(), row.data() + 4);
            start = start->with(entries);
        } else {   // ArcSim's factor 2 belongs to the file
            start = start->with({2 * data.stretching[0][0], 2 * data.stretching[0][1], 2 * data.stretching[1][0], 2 * data.stretching[1][1]});
        }
        density = data.density;
    }
    const FitResult r = fit_table(p, measured, std::move(start), [&](int step, double misfit) {
        progress.update({step, -1, -1, {}, "misfit " + format_short(misfit) + " times the noise"});
    });
    finish(s, "fit", write_fit(s.dir, r, density));
    progress.end("fit: " + std::to_string(r.iterations) + " steps, misfit " + format_short(r.chi2_per_point) + " times the noise, " +
                 (s.dir / "fit/fit.csv").string());
    if (session.quiet) return;
    for (const FittedEntry& e : r.entries)
        std::printf("  %-14s %12s +- %-12s %s\n", e.name.c_str(), format_short(e.value).c_str(), format_short(e.deviation).c_str(),
                    e.determined ? "" : ("not determined: " + e.why + " (doubled, it changes them by at most about " + format_short(100 * e.influence, 2) + " %)").c_str());
}

}  // namespace

void add_study_commands(CLI::App& app, Session& session) {
    auto pulled = std::make_shared<SceneArguments>();
    CLI::App* command = add_command(app, session, "tensile", "Pull strips of the fabric between clamps: force against displacement",
                                    "  formwork tensile conf/studies/tensile.json -o out/tensile          five strips, CSV and PNG; mm and N\n"
                                    "  formwork tensile conf/studies/tensile.json --set tensile.max_strain=0.1");
    add_scene_arguments(command, *pulled, true);
    command->callback([pulled, &session] { tensile(*pulled, session); });
    auto fitted = std::make_shared<SceneArguments>();
    command = add_command(app, session, "fit", "Estimate a fabric's stiffness table from measured force-displacement curves",
                          "  formwork fit conf/studies/fit.json -o out/fit       mm and N in, N/m out\n"
                          "  formwork fit conf/studies/fit.json --set fit.noise=0.02");
    add_scene_arguments(command, *fitted, true);
    command->callback([fitted, &session] { fit(*fitted, session); });
}

}  // namespace formwork
