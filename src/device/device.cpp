#include "device/device.h"

#include "base/errors.h"
#include "base/log.h"
#include "device/device_state.h"
#include "device/environment.h"

#include <fmt/format.h>

#include <algorithm>

namespace sundog
{

namespace
{

constexpr std::size_t cpu_work_group_size = 256;
constexpr std::size_t gpu_work_group_size = 64;

std::size_t default_work_group_size(const DeviceInfo& info)
{
    const std::uint64_t fallback = info.is_cpu ? cpu_work_group_size : gpu_work_group_size;
    const std::uint64_t wanted = environment_number("SUNDOG_WORK_GROUP_SIZE").value_or(fallback);
    return std::clamp<std::size_t>(wanted, 1, info.largest_work_group);
}

void CL_CALLBACK on_context_message(const char* message, const void*, std::size_t, void*)
{
    log_debug(fmt::format("OpenCL: {}", message));
}

} // namespace

Device::State::State(const DeviceInfo& device_info, const cl::Device& cl_device)
    : info(device_info), device(cl_device), work_group_size(default_work_group_size(info)),
      memory(info.memory_bytes, info.largest_buffer_bytes), profile(*this)
{
    cl_int code = CL_SUCCESS;
    context = cl::Context(device, nullptr, on_context_message, nullptr, &code);
    check(code, "clCreateContext", "the renderer", *this);
    queue = cl::CommandQueue(context, device, CL_QUEUE_PROFILING_ENABLE, &code);
    check(code, "clCreateCommandQueue", "the renderer", *this);
    profile.start_clock();
}

Device::State::~State()
{
    queue.finish();
    programs.store_all();
}

Device::Device(const DeviceInfo& info) : state_(std::make_shared<State>(info, find_opencl_device(info))) {}

Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;
Device::~Device() = default;

const DeviceInfo& Device::info() const
{
    return state_->info;
}
std::size_t Device::work_group_size() const
{
    return state_->work_group_size;
}

void Device::set_work_group_size(std::size_t size)
{
    state_->work_group_size = std::clamp<std::size_t>(size, 1, info().largest_work_group);
}

void Device::finish()
{
    check(state_->queue.finish(), "clFinish", "the renderer", *state_);
}

Profile& Device::profile()
{
    return state_->profile;
}

std::uint64_t Device::allocated_bytes() const
{
    return state_->memory.allocated();
}
std::uint64_t Device::peak_bytes() const
{
    return state_->memory.peak();
}

} // namespace sundog
