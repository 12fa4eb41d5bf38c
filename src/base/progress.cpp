#include "base/progress.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sys/ioctl.h>
#include <unistd.h>

namespace sundog {

namespace {

constexpr double redraw_interval = 0.1; // s
constexpr double first_plain_line = 2.0;
constexpr double second_plain_line = 5.0;
constexpr double plain_interval = 10.0;
// Columns beside the bar, so that its width stays as the text grows.
constexpr int room_for_text = 60;
constexpr int room_for_error = 24;

std::string rate_text(double rate)
{
    return fmt::format("{:.{}f}/s", rate, rate < 10 ? 2 : rate < 100 ? 1 : 0);
}

nlohmann::json optional_number(const std::optional<double>& value) { return value ? nlohmann::json(*value) : nlohmann::json(nullptr); }

} // namespace

std::optional<ProgressMode> parse_progress_mode(const std::string& name)
{
    if (name == "auto") return ::isatty(STDERR_FILENO) ? ProgressMode::bar : ProgressMode::plain;
    if (name == "bar") return ProgressMode::bar;
    if (name == "plain") return ProgressMode::plain;
    if (name == "json") return ProgressMode::json;
    if (name == "off") return ProgressMode::off;
    return std::nullopt;
}

int terminal_columns()
{
    winsize size = {};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
    return 80;
}

std::string format_duration(double seconds)
{
    const auto total = static_cast<std::int64_t>(std::llround(std::max(0.0, std::min(seconds, 1e12))));
    const std::int64_t hours = total / 3600, minutes = total / 60 % 60, rest = total % 60;
    return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, rest) : fmt::format("{}:{:02}", minutes, rest);
}

Progress::Progress(ProgressMode mode, ProgressGoal goal, std::ostream& out, int columns) : mode_(mode), goal_(goal), out_(out), columns_(columns) {}

Progress::State Progress::evaluate(std::uint64_t iterations, double seconds) const
{
    State state{iterations, seconds, 0.0, std::nullopt, std::nullopt};
    if (iterations > goal_.resumed_iterations && seconds > 0.0) state.rate = static_cast<double>(iterations - goal_.resumed_iterations) / seconds;
    auto consider = [&](double fraction, double left) {
        state.fraction = std::clamp(std::max(state.fraction, fraction), 0.0, 1.0);
        state.seconds_left = std::max(0.0, std::min(left, state.seconds_left.value_or(left)));
    };
    if (goal_.seconds) consider(seconds / *goal_.seconds, *goal_.seconds - seconds);
    if (goal_.iterations) {
        const double done = static_cast<double>(iterations), total = static_cast<double>(*goal_.iterations);
        if (state.rate) consider(done / total, (total - done) / *state.rate);
        else state.fraction = std::clamp(std::max(state.fraction, done / total), 0.0, 1.0);
    }
    if (goal_.error && error_.iterations > 0 && std::isfinite(error_.value)) {
        const double needed = static_cast<double>(error_.iterations) * std::pow(error_.value / goal_.error->target, 1.0 / goal_.error->rate);
        const double done = static_cast<double>(iterations);
        if (state.rate) consider(done / needed, (needed - done) / *state.rate);
    }
    return state;
}

bool Progress::due(double seconds) const
{
    if (mode_ == ProgressMode::off) return false;
    if (mode_ != ProgressMode::plain) return !last_printed_ || seconds - *last_printed_ >= redraw_interval;
    if (!last_printed_) return seconds >= first_plain_line;
    if (*last_printed_ < second_plain_line) return seconds >= second_plain_line;
    return seconds - *last_printed_ >= plain_interval;
}

std::string Progress::counts(const State& state) const
{
    std::string text = fmt::format("{}", state.iterations);
    if (goal_.iterations) text += fmt::format("/{}", *goal_.iterations);
    text += " iterations";
    if (state.rate) text += ", " + rate_text(*state.rate);
    text += ", " + format_duration(state.seconds);
    if (state.seconds_left) text += ", " + format_duration(*state.seconds_left) + " left";
    if (goal_.error && error_.iterations > 0) text += fmt::format(", error {:.3g} of {:.3g}", error_.value, goal_.error->target);
    return text;
}

void Progress::print_bar(const State& state)
{
    const std::string text = fmt::format(" {:3.0f}%  {}", 100.0 * state.fraction, counts(state));
    std::string line;
    if (const int width = std::min(columns_ - room_for_text - (goal_.error ? room_for_error : 0), 40); width >= 10) {
        const int filled = static_cast<int>(std::floor(state.fraction * width));
        line = "[" + std::string(static_cast<std::size_t>(filled), '#') + std::string(static_cast<std::size_t>(width - filled), '.') + "]";
    }
    line += text;
    line.resize(std::min<std::size_t>(line.size(), static_cast<std::size_t>(std::max(columns_ - 1, 1))));
    out_ << "\r\x1b[2K" << line << std::flush; // erases the line, then draws
    drawn_ = true;
}

void Progress::print(const State& state)
{
    last_printed_ = state.seconds;
    if (mode_ == ProgressMode::bar) {
        print_bar(state);
    } else if (mode_ == ProgressMode::plain) {
        out_ << fmt::format("sundog: {:.0f}%, {}\n", 100.0 * state.fraction, counts(state)) << std::flush;
    } else if (mode_ == ProgressMode::json) {
        nlohmann::ordered_json line;
        line["iterations"] = state.iterations;
        line["total_iterations"] = goal_.iterations ? nlohmann::json(*goal_.iterations) : nlohmann::json(nullptr);
        line["fraction"] = state.fraction;
        line["seconds"] = state.seconds;
        line["seconds_left"] = optional_number(state.seconds_left);
        line["iterations_per_second"] = optional_number(state.rate);
        if (goal_.error) {
            line["error"] = error_.iterations > 0 ? nlohmann::json(error_.value) : nlohmann::json(nullptr);
            line["target_error"] = goal_.error->target;
        }
        out_ << line.dump() << '\n' << std::flush;
    }
}

void Progress::update(std::uint64_t iterations, double seconds)
{
    if (due(seconds)) print(evaluate(iterations, seconds));
}

void Progress::set_error(std::uint64_t iterations, double error) { error_ = {iterations, error}; }

void Progress::finish(std::uint64_t iterations, double seconds)
{
    if (mode_ == ProgressMode::off || (mode_ == ProgressMode::plain && !last_printed_ && seconds < first_plain_line)) return;
    print(evaluate(iterations, seconds));
    if (mode_ == ProgressMode::bar) out_ << '\n' << std::flush;
    drawn_ = false;
}

void Progress::clear()
{
    if (!drawn_) return;
    out_ << "\r\x1b[2K" << std::flush;
    drawn_ = false;
}

} // namespace sundog
