#include <cstdio>
#include <memory>

#include "formwork/cli/session.hpp"
#include "formwork/study/sweep.hpp"

namespace formwork {

namespace {

struct SweepArguments {
    std::string file, out;
    int processes = 0;
    int point = -1;
    bool list = false, collect = false;
};

void sweep(const SweepArguments& a, Session& session) {
    const std::filesystem::path file(a.file);
    const Sweep s(file, a.out.empty() ? std::filesystem::path("out") / file.stem() : std::filesystem::path(a.out));
    if (a.point >= 0) {
        session.exit_code = s.run_point(a.point);
        return;
    }
    s.write_points();
    arcsim::Progress progress(session.verbosity());
    if (!a.list && !a.collect) {
        if (s.run(a.processes, progress) > 0) session.exit_code = 3;
    }
    const SweepResults results = a.list ? SweepResults{} : s.collect();
    for (const std::string& warning : results.warnings) progress.warning(warning);
    if (session.quiet) return;
    if (a.list)
        std::printf("%s: %zu points\n", (s.out() / "points.csv").c_str(), s.points().size());
    else
        std::printf("%s: %d of %zu points finished\n", (s.out() / "results.csv").c_str(), results.finished, s.points().size());
}

}  // namespace

void add_sweep_command(CLI::App& app, Session& session) {
    CLI::App* command = add_command(app, session, "sweep", "Run many scenes: a grid or list of overrides; resumable; one tidy CSV",
                                    "  formwork sweep conf/sweeps/fill_density.json -o out/fill    run, or go on with what is not finished\n"
                                    "  formwork sweep conf/sweeps/fill_density.json -o out/fill --point 3   one point, as a cluster's task");
    auto a = std::make_shared<SweepArguments>();
    command->add_option("SWEEP", a->file, "Sweep file (JSON)")->required()->type_name("");
    command->add_option("-o,--output", a->out, "Output folder. Default: out/ and the file's name")->type_name("FOLDER");
    command->add_option("-j,--processes", a->processes, "Points that run at once; 0: as the file says, or one per core")->type_name("N");
    auto* point = command->add_option("--point", a->point, "Run this one point only, unless it is finished")->type_name("N");
    auto* list = command->add_flag("--list", a->list, "Write points.csv and run nothing");
    auto* collect = command->add_flag("--collect", a->collect, "Write results.csv from what is finished and run nothing");
    point->excludes(list)->excludes(collect);
    list->excludes(collect);
    command->callback([a, &session] { sweep(*a, session); });
}

}  // namespace formwork
