#include "render/bench_timing.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <thread>
#include <vector>

namespace sundog {

namespace {

double wall_seconds()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_seconds()
{
    timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec)) / std::thread::hardware_concurrency();
}

double seconds_of(bool by_cpu, const std::function<void()>& work)
{
    const auto clock = by_cpu ? cpu_seconds : wall_seconds;
    const double start = clock();
    work();
    return clock() - start;
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

} // namespace

PairedTimes time_in_turn(bool by_cpu, int rounds, const std::function<void()>& ours, const std::function<void()>& other)
{
    ours();
    other();
    std::vector<double> times, other_times, ratios;
    double before = seconds_of(by_cpu, other);
    for (int round = 0; round < rounds; round++) {
        const double time = seconds_of(by_cpu, ours);
        const double after = seconds_of(by_cpu, other);
        times.push_back(time);
        other_times.push_back(after);
        ratios.push_back(0.5 * (before + after) / time);
        before = after;
    }
    return {median(times), median(other_times), median(ratios)};
}

double time_alone(bool by_cpu, int rounds, const std::function<void()>& work)
{
    work();
    std::vector<double> times;
    for (int round = 0; round < rounds; round++) times.push_back(seconds_of(by_cpu, work));
    return median(times);
}

} // namespace sundog
