// What an opened device holds. For src/device alone.
#pragma once

#include "device/event_profile.h"
#include "device/memory_account.h"
#include "device/opencl.h"
#include "device/program_shelf.h"

namespace sundog
{

struct Device::State {
    State(const DeviceInfo& device_info, const cl::Device& cl_device);
    ~State();
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    DeviceInfo info;
    cl::Device device;
    cl::Context context;
    cl::CommandQueue queue;
    std::size_t work_group_size = 1;
    MemoryAccount memory;
    EventProfile profile;
    ProgramShelf programs;
};

// The OpenCL device that list_devices() described. Throws DeviceError when it is gone.
cl::Device find_opencl_device(const DeviceInfo& info);

} // namespace sundog
