// The profile of a device: OpenCL events, folded into sums per label.
#pragma once

#include "device/event_clock.h"
#include "device/opencl.h"
#include "device/profile.h"

#include <deque>
#include <mutex>
#include <unordered_map>

namespace sundog
{

// Run time of a finished command on the device (s); 0 when the driver does not tell.
double event_seconds(const cl::Event& event);

// Keeps a bounded number of events, however many launches there are. Thread-safe.
class EventProfile final : public Profile
{
public:
    explicit EventProfile(const Device::State& device) : device_(device) {}

    // Takes the event of one launch of the stage. Throws DeviceError if an earlier launch failed on the device.
    void add(const std::string& label, cl::Event event);
    void add_build_seconds(double seconds);
    void add_program(double seconds, bool from_cache);

    // Starts to compare the device's clock with the host's; once the queue is there.
    void start_clock();

    std::vector<StageTime> stages() override;
    bool tells_seconds() override;
    double build_seconds() const override;
    std::uint64_t programs_built() const override;
    std::uint64_t programs_loaded() const override;
    void reset() override;

private:
    struct Pending {
        std::size_t stage;
        cl::Event event;
    };

    double device_now();
    std::size_t stage_index(const std::string& label);
    void fold_finished();
    void fold_all();
    void fold_front();

    const Device::State& device_;
    mutable std::mutex mutex_;
    std::vector<StageTime> stages_;
    std::unordered_map<std::string, std::size_t> index_;
    std::deque<Pending> pending_;
    EventClock clock_;
    double busy_ = 0.0; // since the clock was started
    double build_seconds_ = 0.0;
    std::uint64_t programs_built_ = 0;
    std::uint64_t programs_loaded_ = 0;
};

} // namespace sundog
