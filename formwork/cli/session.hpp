#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "arcsim/base/progress.hpp"

namespace formwork {

/// What all commands share: how to talk, and the exit code to end with.
struct Session {
    bool quiet = false, json = false;
    int exit_code = 0;
    std::map<std::string, std::string> examples;   // of each command, for its help and the manual

    arcsim::Verbosity verbosity() const {
        return json ? arcsim::Verbosity::json : quiet ? arcsim::Verbosity::quiet : arcsim::Verbosity::normal;
    }
};

/// Options of commands that read a scene.
struct SceneArguments {
    std::string scene, out;
    std::vector<std::string> overrides;
    std::optional<int> threads;
    bool ignore_unsupported = false, resume = false;
};

/// A subcommand whose help begins with examples.
CLI::App* add_command(CLI::App& app, Session& session, const std::string& name, const std::string& what,
                      const std::string& examples);
/// SCENE, --set, --threads, --ignore-unsupported; and with_output: -o, --resume.
void add_scene_arguments(CLI::App* command, SceneArguments& arguments, bool with_output);

// One function per command, each in its own file; their callbacks do the work.
void add_run_command(CLI::App& app, Session& session);
void add_stage_commands(CLI::App& app, Session& session);
void add_check_command(CLI::App& app, Session& session);
void add_schema_command(CLI::App& app, Session& session);
void add_init_command(CLI::App& app, Session& session);
void add_mesh_command(CLI::App& app, Session& session);
void add_show_command(CLI::App& app, Session& session);
void add_compare_command(CLI::App& app, Session& session);
void add_sweep_command(CLI::App& app, Session& session);
void add_study_commands(CLI::App& app, Session& session);   // tensile, fit

void add_manual_command(CLI::App& app, Session& session);

/// "formwork 0.1.0" and what it was built with and runs on.
std::string version_text();

}  // namespace formwork
