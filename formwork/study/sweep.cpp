#include "formwork/study/sweep.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <thread>
#include <utility>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "arcsim/base/interrupt.hpp"
#include "arcsim/base/json_reader.hpp"
#include "arcsim/base/json_value.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/study/process.hpp"
#include "formwork/study/sweep_chart.hpp"
#include "formwork/study/sweep_inputs.hpp"
#include "formwork/study/sweep_table.hpp"

namespace formwork {
namespace {

using Clock = std::chrono::steady_clock;
using std::filesystem::path;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Holds a point's folder while it runs, so that two sweeps or two cluster tasks never run it at once.
/// The system lets go of it when the process ends, however it ends.
class FolderLock {
public:
    explicit FolderLock(const path& folder) {
        fd_ = open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
        if (fd_ < 0) throw arcsim::InputError((folder / "lock").string() + ": cannot be written. Choose another output folder with -o.");
        held_ = flock(fd_, LOCK_EX | LOCK_NB) == 0;
    }
    FolderLock(FolderLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)), held_(other.held_) {}
    FolderLock& operator=(FolderLock&&) = delete;
    ~FolderLock() {
        if (fd_ >= 0) close(fd_);
    }
    bool held() const { return held_; }

private:
    int fd_ = -1;
    bool held_ = false;
};

/// The last line of a log that says something: the error's own words.
std::string last_line(const path& log) {
    std::string text;
    try {
        text = arcsim::read_text_file(log);
    } catch (const arcsim::InputError&) {
        return "";
    }
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
    const auto start = text.rfind('\n');
    return start == std::string::npos ? text : text.substr(start + 1);
}

}  // namespace

Sweep::Sweep(const path& sweep_file, path out) : out_(std::move(out)) {
    const arcsim::JsonDocument document = arcsim::read_json(sweep_file);
    arcsim::Warnings warnings;
    arcsim::read_params(arcsim::JsonNode(document), params_, warnings);
    try {
        points_ = plan_points(params_);
    } catch (const arcsim::InputError& e) {
        throw arcsim::InputError(document.source + ": " + e.what());
    }
}

path Sweep::folder(const SweepPoint& p) const {
    std::string number = std::to_string(p.number);
    number.insert(0, number.size() < 4 ? 4 - number.size() : 0, '0');
    return out_ / "points" / number;
}

std::string Sweep::fingerprint(const SweepPoint& p) const {
    std::vector<std::string> words{params_.from_stage, params_.to_stage};
    for (const auto& [key, value] : p.overrides) words.insert(words.end(), {key, value});
    return fingerprint_inputs(params_.scene.path, words);
}

std::vector<std::string> Sweep::command(const SweepPoint& p) const {
    std::vector<std::string> words{own_program(), "run", params_.scene.path, "-o", folder(p)};
    for (const auto& [key, value] : p.overrides) words.insert(words.end(), {"--set", key + "=" + value});
    if (!params_.from_stage.empty()) words.insert(words.end(), {"--from", params_.from_stage});
    if (!params_.to_stage.empty()) words.insert(words.end(), {"--to", params_.to_stage});
    words.insert(words.end(), {"--threads", "1"});
    return words;
}

Sweep::Status Sweep::status(const SweepPoint& p) const {
    const path file = folder(p) / "status.json";
    if (!std::filesystem::exists(file)) return {};
    const arcsim::JsonDocument document = arcsim::read_json(file);
    const arcsim::JsonNode node(document);
    if (node.at("fingerprint").string() != fingerprint(p)) return {};
    return {true, node.at("exit_code").integer(), node.at("wall_s").number(), node.at("message").string()};
}

void Sweep::write_status(const SweepPoint& p, int exit_code, double wall_s) const {
    arcsim::JsonValue v = arcsim::JsonValue::object();
    v.set("fingerprint", fingerprint(p));
    v.set("exit_code", exit_code);
    v.set("wall_s", wall_s);
    v.set("message", exit_code == 0 ? "" : last_line(folder(p) / "run.log"));
    arcsim::write_file_atomically(folder(p) / "status.json", arcsim::to_text(v) + "\n");
}

pid_t Sweep::start(const SweepPoint& p) const {
    std::filesystem::remove(folder(p) / "status.json");
    if (params_.from_stage.empty()) std::filesystem::remove(folder(p) / "summary.json");   // of older overrides
    return start_process(command(p), folder(p) / "run.log");
}

int Sweep::run(int processes, arcsim::Progress& progress) const {
    if (processes == 0) processes = params_.processes;
    if (processes == 0) processes = std::max(1u, std::thread::hardware_concurrency());
    write_points();

    struct Running {
        const SweepPoint* point;
        FolderLock lock;
        Clock::time_point start;
    };
    std::map<pid_t, Running> running;
    int failed = 0, done = 0;
    std::vector<const SweepPoint*> waiting;
    for (const SweepPoint& p : points_) {
        const Status s = status(p);
        if (!s.finished) waiting.push_back(&p);
        done += s.finished;
        failed += s.finished && s.exit_code != 0;
    }
    if (done > 0) progress.message(std::to_string(done) + " of " + std::to_string(points_.size()) + " points were finished before");

    progress.begin("sweep");
    std::reverse(waiting.begin(), waiting.end());
    while (!waiting.empty() || !running.empty()) {
        while (!waiting.empty() && static_cast<int>(running.size()) < processes) {
            const SweepPoint& p = *waiting.back();
            waiting.pop_back();
            std::filesystem::create_directories(folder(p));
            FolderLock lock(folder(p));
            if (!lock.held()) {
                progress.warning("point " + std::to_string(p.number) + " is being run by another process: left to it");
                continue;
            }
            running.emplace(start(p), Running{&p, std::move(lock), Clock::now()});
        }
        const EndedProcess ended = wait_for_process(0.5);
        if (const auto it = running.find(ended.pid); it != running.end()) {
            // 128 and above: killed from outside or by Ctrl-C; such a point is not finished and runs again.
            if (ended.exit_code < 128) {
                write_status(*it->second.point, ended.exit_code, seconds_since(it->second.start));
                ++done;
            }
            failed += ended.exit_code != 0;
            running.erase(it);
        }
        const double fraction = static_cast<double>(done) / static_cast<double>(points_.size());
        try {
            progress.update({.step = done, .fraction = fraction, .note = "points finished"});
        } catch (const arcsim::Interrupted&) {
            for (const auto& [pid, r] : running) kill(pid, SIGINT);
            while (!running.empty()) running.erase(wait_for_process(60).pid);
            throw;
        }
    }
    progress.end("sweep: " + std::to_string(points_.size()) + " points, " + std::to_string(failed) + " failed");
    return failed;
}

int Sweep::run_point(int number) const {
    if (number < 0 || number >= static_cast<int>(points_.size()))
        throw arcsim::InputError("--point " + std::to_string(number) + ": this sweep has points 0 to " +
                                 std::to_string(points_.size() - 1) + ".");
    const SweepPoint& p = points_[number];
    std::filesystem::create_directories(folder(p));
    FolderLock lock(folder(p));
    if (!lock.held())
        throw arcsim::InputError(folder(p).string() + ": another process runs this point. Wait for it, or use another output folder.");
    if (const Status s = status(p); s.finished) return s.exit_code;
    const auto began = Clock::now();
    const pid_t pid = start(p);
    EndedProcess ended;
    while (ended.pid != pid) {
        ended = wait_for_process(1);
        if (ended.pid == 0 && arcsim::interrupt_requested()) kill(pid, SIGINT);
    }
    if (ended.exit_code >= 128) throw arcsim::Interrupted();
    write_status(p, ended.exit_code, seconds_since(began));
    return ended.exit_code;
}

void Sweep::write_points() const { arcsim::write_file_atomically(out_ / "points.csv", points_table(points_).csv()); }

SweepResults Sweep::collect() const {
    SweepResults results;
    std::vector<SweepRow> rows;
    for (const SweepPoint& p : points_) {
        const Status s = status(p);
        results.finished += s.finished;
        const char* word = !s.finished ? "missing" : s.exit_code == 0 ? "done" : s.exit_code == 2 ? "wrong input" : "failed";
        rows.push_back({&p, word, s.exit_code, s.wall_s, s.message, folder(p) / "summary.json"});
    }
    const SweepTable table = results_table(rows);
    arcsim::write_file_atomically(out_ / "results.csv", table.csv());
    if (results.finished > 0) results.warnings = draw_sweep_charts(params_, table, out_);
    return results;
}

}  // namespace formwork
