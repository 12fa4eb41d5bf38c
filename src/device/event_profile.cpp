#include "device/event_profile.h"

#include "device/device_state.h"

#include <fmt/format.h>

#include <chrono>

namespace sundog
{

namespace
{

// Finished events are looked for when so many are waiting, and waited for when the host is too far ahead.
constexpr std::size_t fold_at = 64;
constexpr std::size_t wait_at = 512;

double host_now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace

double event_seconds(const cl::Event& event)
{
    cl_ulong begin = 0, end = 0;
    if (event.getProfilingInfo(CL_PROFILING_COMMAND_START, &begin) != CL_SUCCESS ||
        event.getProfilingInfo(CL_PROFILING_COMMAND_END, &end) != CL_SUCCESS || end < begin)
        return 0.0;
    return double(end - begin) * 1e-9;
}

void EventProfile::add(const std::string& label, cl::Event event)
{
    std::lock_guard lock(mutex_);
    pending_.push_back({stage_index(label), std::move(event)});
    if (pending_.size() % fold_at == 0) fold_finished();
    if (pending_.size() >= wait_at) {
        pending_[wait_at / 2].event.wait();
        fold_finished();
    }
}

void EventProfile::add_build_seconds(double seconds)
{
    std::lock_guard lock(mutex_);
    build_seconds_ += seconds;
}

void EventProfile::add_program(double seconds, bool from_cache)
{
    std::lock_guard lock(mutex_);
    build_seconds_ += seconds;
    ++(from_cache ? programs_loaded_ : programs_built_);
}

std::vector<StageTime> EventProfile::stages()
{
    std::lock_guard lock(mutex_);
    fold_all();
    return stages_;
}

// By the end of a command that does nothing. A driver that tells no time of such a one is believed to go as the host does.
double EventProfile::device_now()
{
    cl::Event marker;
    cl_ulong end = 0;
    if (device_.queue.enqueueMarkerWithWaitList(nullptr, &marker) != CL_SUCCESS || marker.wait() != CL_SUCCESS ||
        marker.getProfilingInfo(CL_PROFILING_COMMAND_END, &end) != CL_SUCCESS || end == 0)
        return host_now();
    return double(end) * 1e-9;
}

void EventProfile::start_clock()
{
    std::lock_guard lock(mutex_);
    const double device = device_now();
    clock_.start(device, host_now());
    busy_ = 0.0;
}

bool EventProfile::tells_seconds()
{
    std::lock_guard lock(mutex_);
    fold_all();
    const double device = device_now();
    return clock_.tells_seconds(device, host_now(), busy_);
}

double EventProfile::build_seconds() const
{
    std::lock_guard lock(mutex_);
    return build_seconds_;
}

std::uint64_t EventProfile::programs_built() const
{
    std::lock_guard lock(mutex_);
    return programs_built_;
}

std::uint64_t EventProfile::programs_loaded() const
{
    std::lock_guard lock(mutex_);
    return programs_loaded_;
}

void EventProfile::reset()
{
    std::unique_lock lock(mutex_);
    fold_all();
    stages_.clear();
    index_.clear();
    build_seconds_ = 0.0;
    programs_built_ = 0;
    programs_loaded_ = 0;
    lock.unlock();
    start_clock();
}

std::size_t EventProfile::stage_index(const std::string& label)
{
    auto [found, inserted] = index_.try_emplace(label, stages_.size());
    if (inserted) stages_.push_back({label, 0.0, 0});
    return found->second;
}

// The queue is in order: the first unfinished event ends the search.
void EventProfile::fold_finished()
{
    while (!pending_.empty()) {
        cl_int status = pending_.front().event.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>();
        if (status > CL_COMPLETE) return;
        fold_front();
    }
}

void EventProfile::fold_all()
{
    if (pending_.empty()) return;
    pending_.back().event.wait();
    while (!pending_.empty()) fold_front();
}

void EventProfile::fold_front()
{
    Pending done = std::move(pending_.front());
    pending_.pop_front();
    StageTime& stage = stages_[done.stage];
    cl_int status = done.event.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>();
    if (status < CL_COMPLETE) throw_opencl_error(status, "execution", fmt::format("stage '{}'", stage.label), device_);
    const double seconds = event_seconds(done.event);
    stage.seconds += seconds;
    busy_ += seconds;
    ++stage.launches;
}

} // namespace sundog
