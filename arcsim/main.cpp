#include <CLI/CLI.hpp>
#include <iostream>

#include "arcsim/base/error.hpp"
#include "arcsim/base/interrupt.hpp"
#include "arcsim/scene/run_scene.hpp"
#include "arcsim/solve/linear_solver.hpp"

namespace {

struct Arguments {
    std::string scene, folder;
    int frame = 0;
    bool ignore_unsupported = false, quiet = false, json = false;
    int threads = 1;
};

int run(const Arguments& a, bool resume) {
    using namespace arcsim;
    Progress progress(a.json ? Verbosity::json : a.quiet ? Verbosity::quiet : Verbosity::normal);
    RunStatus status;
    const auto kept = [&] {
        return status.last_frame < 0 ? std::string("No frame was saved.")
                                     : "Frames up to " + std::to_string(status.last_frame) + " are kept in " + a.folder + ".";
    };
    try {
        if (a.threads > 0) set_blas_threads(a.threads);
        const Scene scene = read_scene(a.scene, a.ignore_unsupported ? Unsupported::warn : Unsupported::error);
        for (const std::string& warning : scene.warnings) progress.warning(warning);
        if (resume)
            resume_scene(scene, a.folder, a.frame, progress, status);
        else
            run_scene(scene, a.folder, progress, status);
        return 0;
    } catch (const InputError& e) {
        std::cerr << "arcsim: " << e.what() << '\n';
        return 2;
    } catch (const NumericalError& e) {
        std::cerr << "arcsim: " << e.what() << ' ' << kept() << '\n';
        return 3;
    } catch (const Interrupted&) {
        std::cerr << "arcsim: interrupted at t = " << status.time << " s. " << kept();
        if (status.last_frame >= 0)
            std::cerr << " Continue with: arcsim resume " << a.folder << ' ' << status.last_frame << ' ' << a.scene;
        std::cerr << '\n';
        return 130;
    } catch (const std::exception& e) {
        std::cerr << "arcsim: internal error: " << e.what() << '\n';
        return 3;
    }
}

}  // namespace

int main(int argc, char** argv) {
    arcsim::catch_interrupts();
    Arguments a;
    CLI::App app("Cloth simulation of ArcSim scenes: writes FFFF_CC.obj per frame and cloth.", "arcsim");
    app.set_version_flag("--version", FORMWORK_VERSION);
    app.add_option("SCENE", a.scene, "Scene file");
    app.add_option("OUT", a.folder, "Folder for the frames");
    CLI::App* resume = app.add_subcommand("resume", "Continue a run behind a saved frame");
    resume->add_option("OUT", a.folder, "Folder of the run")->required();
    resume->add_option("FRAME", a.frame, "Frame to continue from")->required()->check(CLI::NonNegativeNumber);
    resume->add_option("SCENE", a.scene, "Scene file")->required();
    for (CLI::App* command : {&app, resume}) {
        command->add_flag("--ignore-unsupported", a.ignore_unsupported, "Leave out what is not modelled, and keys that are not known, instead of stopping");
        command->add_flag("--quiet", a.quiet, "Only warnings and errors");
        command->add_flag("--json", a.json, "Progress as one JSON object a line");
        command->add_option("--threads", a.threads, "Threads of the dense kernels")->check(CLI::Range(0, 256));
    }
    try {
        app.parse(argc, argv);
        if (!resume->parsed() && (a.scene.empty() || a.folder.empty()))
            throw CLI::RequiredError("SCENE and OUT");
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : 2;
    }
    return run(a, resume->parsed());
}
