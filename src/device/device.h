// The OpenCL device: choice, context and queue. Outside this folder nobody sees
// a cl_* name; every OpenCL failure becomes a DeviceError that says the call, the
// kernel, the device and, for builds, the log.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sundog
{

// One OpenCL device, as `sundog devices` lists it.
struct DeviceInfo {
    int index = 0; // position in list_devices()
    std::string name;
    std::string platform;
    std::string driver;
    std::string version; // of OpenCL
    bool is_cpu = false;
    bool is_gpu = false;
    bool unified_memory = false;
    unsigned compute_units = 0;
    std::uint64_t memory_bytes = 0;
    std::uint64_t largest_buffer_bytes = 0;
    std::size_t largest_work_group = 0;
    bool has_int64_atomics = false;
};

// Every device of every platform, in a stable order. Empty when there is none.
std::vector<DeviceInfo> list_devices();

// Chooses by selector: "" (a GPU if there is one, else the first), "cpu", "gpu", an index, a part of a name (case
// ignored), or "all" (where there is only one; several at once are refused). Throws DeviceError when nothing
// matches, naming what there is, and, without any device, with the packages to install.
DeviceInfo select_device(std::string_view selector);

class Profile;

// An opened device. Movable, not copyable; buffers and kernels keep the OpenCL objects behind it alive.
class Device
{
public:
    explicit Device(const DeviceInfo& info);
    Device(Device&&) noexcept;
    Device& operator=(Device&&) noexcept;
    ~Device();

    const DeviceInfo& info() const;

    // Work-items of a group for every launch: one fixed size, since PoCL compiles a kernel anew for each.
    std::size_t work_group_size() const;
    void set_work_group_size(std::size_t size);

    // Waits until all enqueued work is done.
    void finish();

    // Time per stage, kernel builds, and memory; see profile.h.
    Profile& profile();

    std::uint64_t allocated_bytes() const;
    std::uint64_t peak_bytes() const;

    struct State; // OpenCL objects, known to src/device alone
    State& state() const { return *state_; }
    const std::shared_ptr<State>& shared_state() const { return state_; }

private:
    std::shared_ptr<State> state_;
};

} // namespace sundog
