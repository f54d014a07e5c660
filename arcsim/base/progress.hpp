#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace arcsim {

/// How a program talks while it works.
enum class Verbosity { normal, quiet, json };

/// Where a long calculation stands. `fraction` is an estimate of the work done, 0..1, if there is one.
struct ProgressState {
    int step = 0;
    double residual = -1, goal = -1;        // < 0: not shown
    std::optional<double> fraction;
    std::string note;                       // e.g. "level 62 %, max stretch 1.07"
};

/// Shows progress on stderr: on a terminal one line that is rewritten (ten times a second at most), otherwise
/// a plain line every five seconds; with `json` one JSON object a line; with `quiet` nothing but warnings.
/// Calculations call update() as often as they like; it also is where Ctrl-C is noticed.
class Progress {
public:
    explicit Progress(Verbosity verbosity = Verbosity::quiet) : verbosity_(verbosity) {}
    ~Progress() { finish_line(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void begin(std::string_view task);              ///< "inflate"
    void update(const ProgressState& state);        ///< @throws Interrupted after Ctrl-C
    void end(std::string_view summary);             ///< one line that stays: "inflate: 14 steps, 2.1 s"
    void message(std::string_view text);            ///< a plain line, unless quiet
    void warning(std::string_view text);            ///< always shown, also when quiet

private:
    void line(std::string_view event, std::string_view text);
    void finish_line();
    std::string time_left(const ProgressState& state, double elapsed);

    using Clock = std::chrono::steady_clock;
    Verbosity verbosity_;
    std::string task_;
    Clock::time_point start_, shown_;
    std::size_t width_ = 0;          // of the line that is being rewritten
    double first_residual_ = -1;
};

/// Seconds as "0.4 s", "12 s", "3 min 20 s".
std::string format_duration(double seconds);

}  // namespace arcsim
