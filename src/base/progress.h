// How far a render is: a bar on a terminal, plain lines elsewhere, JSON for programs.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>

namespace sundog {

enum class ProgressMode { off, bar, plain, json };

// "auto" is a bar when stderr is a terminal, plain lines otherwise. nullopt for an unknown name.
std::optional<ProgressMode> parse_progress_mode(const std::string& name);

// An error that falls as a power of the number of iterations.
struct ErrorGoal {
    double target = 0.0;
    double rate = 0.5; // error ~ iterations^-rate
};

// When a render ends: after so many iterations, so many seconds, when its error is small enough, or whichever comes first.
struct ProgressGoal {
    std::optional<std::uint64_t> iterations;
    std::optional<double> seconds;
    std::uint64_t resumed_iterations = 0; // done before the clock started; the rate is of the others
    std::optional<ErrorGoal> error = {};
};

// Prints to `out`. Times are given by the caller, in seconds since the start.
//   bar    one line, drawn anew in place at most every 0.1 s
//   plain  a line at 2 s, 5 s, and then at most every 10 s
//   json   an object a line, at most every 0.1 s: iterations, total_iterations, fraction, seconds,
//          seconds_left, iterations_per_second (null where unknown); with a goal for the error also error,
//          the latest that is known, and target_error
// The first and the last state are always printed, except by plain when a render took under 2 s.
class Progress {
public:
    Progress(ProgressMode mode, ProgressGoal goal, std::ostream& out, int columns = 80);

    void update(std::uint64_t iterations, double seconds);
    void set_error(std::uint64_t iterations, double error); // what was found after so many iterations; printed from the next update on
    void finish(std::uint64_t iterations, double seconds);
    void clear(); // takes a drawn bar off the terminal, so that a message can be printed

private:
    struct State {
        std::uint64_t iterations;
        double seconds;
        double fraction; // 0..1
        std::optional<double> rate; // iterations/s
        std::optional<double> seconds_left;
    };
    State evaluate(std::uint64_t iterations, double seconds) const;
    bool due(double seconds) const;
    void print(const State& state);
    void print_bar(const State& state);
    std::string counts(const State& state) const;

    ProgressMode mode_;
    ProgressGoal goal_;
    struct {
        std::uint64_t iterations;
        double value;
    } error_ = {0, 0.0}; // no iterations: none known yet
    std::ostream& out_;
    int columns_;
    std::optional<double> last_printed_;
    bool drawn_ = false;
};

// Width of the terminal at stderr; 80 when it is none.
int terminal_columns();

// "0:07", "12:34", "3:25:01".
std::string format_duration(double seconds);

} // namespace sundog
