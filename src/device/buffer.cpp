#include "device/buffer.h"

#include "base/errors.h"
#include "device/device_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <sys/mman.h>

namespace sundog
{

namespace
{

constexpr std::size_t huge_page = std::size_t(2) << 20;
constexpr std::size_t small_alignment = 64;

[[noreturn]] void throw_out_of_memory(const Device::State& device, const std::string& label, std::size_t bytes, cl_int code)
{
    const std::string cause = code == CL_SUCCESS ? "" : ": " + opencl_error_name(code);
    throw OutOfDeviceMemory(fmt::format("out of memory on device '{}': buffer '{}' needs {}{}; {}; render a smaller film, use fewer photons "
                                  "per iteration, or choose another device with --device",
                                  device.info.name, label, format_bytes(bytes), cause, device.memory.describe()));
}

std::size_t round_up(std::size_t value, std::size_t multiple)
{
    return (value + multiple - 1) / multiple * multiple;
}

// Host memory that a CPU device uses in place; nullptr when there is none.
void* allocate_host_memory(std::size_t bytes)
{
    const std::size_t alignment = bytes >= huge_page ? huge_page : small_alignment;
    void* memory = std::aligned_alloc(alignment, round_up(bytes, alignment));
    // Advice only: where huge pages are switched off, small ones serve.
    if (memory && alignment == huge_page) ::madvise(memory, round_up(bytes, alignment), MADV_HUGEPAGE);
    return memory;
}

void CL_CALLBACK free_host_memory(cl_mem, void* memory)
{
    std::free(memory);
}

cl_mem handle(void* memory)
{
    return static_cast<cl_mem>(memory);
}

} // namespace

RawBuffer::RawBuffer(Device& device, std::size_t bytes, std::string label)
    : device_(device.shared_state()), bytes_(bytes), allocated_(round_up(std::max<std::size_t>(bytes, 1), small_alignment)),
      label_(std::move(label))
{
    Device::State& state = *device_;
    if (!state.memory.reserve(allocated_)) throw_out_of_memory(state, label_, allocated_, CL_SUCCESS);
    cl_int code = CL_SUCCESS;
    if (state.info.is_cpu) {
        void* host = allocate_host_memory(allocated_);
        if (host) {
            memory_ = clCreateBuffer(state.context(), CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, allocated_, host, &code);
            // Freed when the device is done with it, which may be after this object's end.
            if (memory_)
                code = clSetMemObjectDestructorCallback(handle(memory_), free_host_memory, host);
            else
                std::free(host);
        } else {
            code = CL_OUT_OF_HOST_MEMORY;
        }
    } else {
        memory_ = clCreateBuffer(state.context(), CL_MEM_READ_WRITE, allocated_, nullptr, &code);
    }
    if (code == CL_SUCCESS) return;
    state.memory.release(allocated_);
    if (is_out_of_memory(code)) throw_out_of_memory(state, label_, allocated_, code);
    throw_opencl_error(code, "clCreateBuffer", fmt::format("buffer '{}'", label_), state);
}

RawBuffer::RawBuffer(RawBuffer&& other) noexcept
    : device_(std::move(other.device_)), memory_(std::exchange(other.memory_, nullptr)), bytes_(std::exchange(other.bytes_, 0)),
      allocated_(std::exchange(other.allocated_, 0)), label_(std::move(other.label_))
{
}

RawBuffer& RawBuffer::operator=(RawBuffer&& other) noexcept
{
    std::swap(device_, other.device_);
    std::swap(memory_, other.memory_);
    std::swap(bytes_, other.bytes_);
    std::swap(allocated_, other.allocated_);
    std::swap(label_, other.label_);
    return *this;
}

RawBuffer::~RawBuffer()
{
    if (!memory_) return;
    clReleaseMemObject(handle(memory_));
    device_->memory.release(allocated_);
}

RawBuffer RawBuffer::share(std::string label) const
{
    assert(memory_);
    RawBuffer other;
    check(clRetainMemObject(handle(memory_)), "clRetainMemObject", fmt::format("buffer '{}'", label), *device_);
    other.device_ = device_;
    other.memory_ = memory_;
    other.bytes_ = bytes_;
    other.label_ = std::move(label);
    return other;
}

void RawBuffer::write(std::size_t offset, const void* source, std::size_t bytes)
{
    assert(memory_ && offset + bytes <= bytes_);
    if (bytes == 0) return;
    const cl_int code = clEnqueueWriteBuffer(device_->queue(), handle(memory_), CL_TRUE, offset, bytes, source, 0, nullptr, nullptr);
    check(code, "clEnqueueWriteBuffer", fmt::format("buffer '{}'", label_), *device_);
}

void RawBuffer::read(std::size_t offset, void* target, std::size_t bytes) const
{
    assert(memory_ && offset + bytes <= bytes_);
    if (bytes == 0) return;
    const cl_int code = clEnqueueReadBuffer(device_->queue(), handle(memory_), CL_TRUE, offset, bytes, target, 0, nullptr, nullptr);
    check(code, "clEnqueueReadBuffer", fmt::format("buffer '{}'", label_), *device_);
}

// PoCL writes a wide pattern two to five times as fast as a word: the pattern is repeated as often as the allocation,
// a multiple of the alignment, allows.
void RawBuffer::fill(const void* pattern, std::size_t pattern_bytes)
{
    assert(memory_ && bytes_ % pattern_bytes == 0);
    if (bytes_ == 0) return;
    std::array<std::byte, 2 * small_alignment> wide;
    std::size_t wide_bytes = 0, filled = bytes_;
    if (small_alignment % pattern_bytes == 0) {
        for (; wide_bytes < small_alignment; wide_bytes += pattern_bytes) std::memcpy(wide.data() + wide_bytes, pattern, pattern_bytes);
        filled = allocated_;
    } else {
        assert(pattern_bytes == wide.size());
        std::memcpy(wide.data(), pattern, wide_bytes = pattern_bytes);
    }
    cl_event event = nullptr;
    const cl_int code = clEnqueueFillBuffer(device_->queue(), handle(memory_), wide.data(), wide_bytes, 0, filled, 0, nullptr, &event);
    check(code, "clEnqueueFillBuffer", fmt::format("buffer '{}'", label_), *device_);
    device_->profile.add("Fill buffers", cl::Event(event));
}

} // namespace sundog
