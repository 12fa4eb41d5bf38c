// Timing for `sundog bench`: two pieces of work in turn, so that a machine whose speed drifts does not spoil
// their ratio.
#pragma once

#include <functional>

namespace sundog {

struct PairedTimes {
    double seconds = 0.0;       // of our work: median over the rounds
    double other_seconds = 0.0; // of the other's
    double ratio = 0.0;         // other / ours: median of the rounds' ratios; above 1 we are faster
};

// Both run once before, to compile and to touch memory. by_cpu: CPU seconds of all threads divided by the
// hardware threads, which other processes do not spoil; else wall seconds.
PairedTimes time_in_turn(bool by_cpu, int rounds, const std::function<void()>& ours, const std::function<void()>& other);

// Median seconds of one piece of work.
double time_alone(bool by_cpu, int rounds, const std::function<void()>& work);

} // namespace sundog
