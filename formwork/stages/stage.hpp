#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "arcsim/base/json_value.hpp"
#include "arcsim/base/progress.hpp"
#include "formwork/scene/formwork_scene.hpp"

namespace formwork {

/// What a stage is given. Everything else it reads from the files of the stages before it.
struct StageContext {
    const FormworkScene& scene;
    std::filesystem::path dir;      // output folder
    arcsim::Progress& progress;
};

/// One row of the pipeline. `run` writes the files of the stage and returns its object of summary.json.
/// @throws InputError before anything is written; NumericalError after what was reached is written and named
struct Stage {
    std::string_view name;
    std::vector<std::string> reads, writes;   // below the output folder
    arcsim::JsonValue (*run)(const StageContext& context);
};

arcsim::JsonValue run_inflate(const StageContext& context);
arcsim::JsonValue run_segment(const StageContext& context);
/// The input of a segment stage that starts from a field file: what the stage would refuse, before anything is written.
/// @throws InputError, also for vertices without faces: a field belongs to the mesh as it is
void check_field_scene(const FormworkScene& scene);
arcsim::JsonValue run_panels(const StageContext& context);
arcsim::JsonValue run_sew(const StageContext& context);
arcsim::JsonValue run_report(const StageContext& context);

/// inflate, segment, panels, sew, report.
const std::vector<Stage>& stages();

struct PipelineOptions {
    std::string from, to;     // stage names; empty: the first, the last
    bool resume = false;      // leave out stages that are finished for this very scene
};

/// Runs a part of the pipeline in the folder `dir`: checks the scene and its mesh, writes scene.json, then runs stage after stage,
/// each followed by summary.json. Entries of stages after the last one that ran are taken out of summary.json, since they no
/// longer belong to its files.
/// @returns bounds of the scene that a stage could not meet, one line each; its files are written
/// @throws InputError   unknown stage, bad scene or mesh, files of an earlier stage missing; dir is untouched
/// @throws NumericalError, Interrupted   finished stages stay
std::vector<std::string> run_pipeline(const FormworkScene& scene, const std::filesystem::path& dir, const PipelineOptions& options,
                                      arcsim::Progress& progress);

}  // namespace formwork
