#include "arcsim/base/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "arcsim/base/interrupt.hpp"
#include "arcsim/base/json_value.hpp"
#include "arcsim/base/text.hpp"

namespace arcsim {

namespace {

const bool terminal = ::isatty(STDERR_FILENO) == 1;

/// Characters that fit in one line: a longer one would wrap and could not be rewritten.
std::size_t terminal_columns() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col - 1u : 79u;
}

double seconds_since(std::chrono::steady_clock::time_point t) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
}

}  // namespace

std::string format_duration(double seconds) {
    char text[32];
    if (seconds < 10) std::snprintf(text, sizeof text, "%.1f s", seconds);
    else if (seconds < 120) std::snprintf(text, sizeof text, "%.0f s", seconds);
    else if (seconds < 7200) std::snprintf(text, sizeof text, "%d min %02d s", static_cast<int>(seconds) / 60, static_cast<int>(seconds) % 60);
    else std::snprintf(text, sizeof text, "%d h %02d min", static_cast<int>(seconds) / 3600, static_cast<int>(seconds) / 60 % 60);
    return text;
}

void Progress::begin(std::string_view task) {
    finish_line();
    task_ = task;
    start_ = Clock::now();
    shown_ = start_;
    first_residual_ = -1;
}

std::string Progress::time_left(const ProgressState& s, double elapsed) {
    std::optional<double> fraction = s.fraction;
    if (!fraction && s.residual > 0 && s.goal > 0) {
        // Residuals fall by orders of magnitude: the logarithm is the nearest thing to work done.
        if (first_residual_ < 0) first_residual_ = s.residual;
        if (first_residual_ > s.goal)
            fraction = std::log(first_residual_ / s.residual) / std::log(first_residual_ / s.goal);
    }
    if (!fraction || *fraction < 0.02 || *fraction > 1 || elapsed < 1) return "";
    return ", about " + format_duration(elapsed * (1 / *fraction - 1)) + " left";
}

void Progress::update(const ProgressState& s) {
    throw_if_interrupted();
    if (verbosity_ == Verbosity::quiet) return;
    const double pause = terminal && verbosity_ == Verbosity::normal ? 0.1 : 5;
    if (seconds_since(shown_) < pause) return;
    shown_ = Clock::now();
    const double elapsed = seconds_since(start_);
    const std::string left = time_left(s, elapsed);
    if (verbosity_ == Verbosity::json) {
        JsonValue v = JsonValue::object();
        v.set("event", "progress");
        v.set("task", task_);
        v.set("step", s.step);
        if (s.residual >= 0) v.set("residual", s.residual);
        if (s.fraction) v.set("fraction", *s.fraction);
        v.set("elapsed_s", elapsed);
        if (!s.note.empty()) v.set("note", s.note);
        std::fprintf(stderr, "%s\n", to_text_one_line(v).c_str());
        return;
    }
    // What matters most comes first: a narrow terminal cuts the end off.
    std::string text = "[" + task_ + "] ";
    if (s.fraction) text += std::to_string(static_cast<int>(100 * *s.fraction)) + " %, ";
    if (s.step > 0) text += "step " + std::to_string(s.step) + ", ";
    if (s.residual >= 0) text += "residual " + format_short(s.residual, 2) + (s.goal >= 0 ? " of " + format_short(s.goal, 2) : "") + ", ";
    text += format_duration(elapsed) + left;
    if (!s.note.empty()) text += "; " + s.note;
    if (terminal) {
        text.resize(std::min(text.size(), terminal_columns()));
        const std::size_t width = text.size();
        if (width < width_) text += std::string(width_ - width, ' ');
        width_ = width;
        std::fprintf(stderr, "\r%s", text.c_str());
        std::fflush(stderr);
    } else {
        std::fprintf(stderr, "%s\n", text.c_str());
    }
}

void Progress::finish_line() {
    if (width_ > 0) std::fprintf(stderr, "\r%*s\r", static_cast<int>(width_), "");
    width_ = 0;
}

void Progress::line(std::string_view event, std::string_view text) {
    finish_line();
    if (verbosity_ != Verbosity::json) {
        std::fprintf(stderr, "%.*s\n", static_cast<int>(text.size()), text.data());
        return;
    }
    JsonValue v = JsonValue::object();
    v.set("event", std::string(event));
    if (!task_.empty()) v.set("task", task_);
    v.set("text", std::string(text));
    std::fprintf(stderr, "%s\n", to_text_one_line(v).c_str());
}

void Progress::end(std::string_view summary) {
    if (verbosity_ != Verbosity::quiet) line("end", summary);
    else finish_line();
    task_.clear();
}

void Progress::message(std::string_view text) {
    if (verbosity_ != Verbosity::quiet) line("message", text);
}

void Progress::warning(std::string_view text) { line("warning", "warning: " + std::string(text)); }

}  // namespace arcsim
