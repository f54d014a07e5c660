#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "arcsim/base/progress.hpp"
#include "formwork/study/sweep_plan.hpp"

namespace formwork {

struct SweepResults {
    int finished = 0;                    // points
    std::vector<std::string> warnings;   // charts that could not be drawn, and why
};

/// A sweep on disk. OUT/points/0007/ is the output folder of point 7; beside the stages' files it holds
/// run.log and status.json, which is written last: a point without it was not finished and runs again.
class Sweep {
public:
    /// @throws InputError
    Sweep(const std::filesystem::path& sweep_file, std::filesystem::path out);

    const std::vector<SweepPoint>& points() const { return points_; }
    const SweepParams& params() const { return params_; }
    const std::filesystem::path& out() const { return out_; }

    /// Runs what is not finished, `processes` at a time (0: as the file says). Returns the number of failed points.
    /// @throws Interrupted after Ctrl-C; finished points stay finished
    int run(int processes, arcsim::Progress& progress) const;
    /// Runs one point here if it is not finished: what a cluster's task calls. Returns its exit code.
    int run_point(int number) const;
    /// Writes OUT/points.csv: number, then one column per key.
    void write_points() const;
    /// Writes OUT/results.csv (one row a point, failed ones too) and OUT/charts/.
    SweepResults collect() const;

private:
    struct Status {
        bool finished = false;
        int exit_code = -1;
        double wall_s = 0;
        std::string message;
    };
    std::filesystem::path folder(const SweepPoint& p) const;
    std::string fingerprint(const SweepPoint& p) const;
    Status status(const SweepPoint& p) const;
    pid_t start(const SweepPoint& p) const;   // of a point whose folder is locked
    std::vector<std::string> command(const SweepPoint& p) const;
    void write_status(const SweepPoint& p, int exit_code, double wall_s) const;

    SweepParams params_;
    std::filesystem::path out_;
    std::vector<SweepPoint> points_;
};

}  // namespace formwork
