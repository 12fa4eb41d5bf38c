// How much device memory Sundog holds, against what there is.
#pragma once

#include "base/errors.h"

#include <atomic>
#include <cstdint>
#include <string>

namespace sundog
{

// Bytes that are allocated now and were at most, and the limits. Thread-safe.
class MemoryAccount
{
public:
    MemoryAccount(std::uint64_t total, std::uint64_t largest_buffer) : total_(total), largest_buffer_(largest_buffer) {}

    // Counts the bytes in if they fit; else leaves all as it was and returns false.
    bool reserve(std::uint64_t bytes);
    void release(std::uint64_t bytes);

    std::uint64_t allocated() const { return allocated_; }
    std::uint64_t peak() const { return peak_; }

    // "Sundog has 3.5 GiB in buffers; the device has 4.0 GiB and allows 2.0 GiB in one buffer".
    std::string describe() const;

private:
    const std::uint64_t total_;
    const std::uint64_t largest_buffer_;
    std::atomic<std::uint64_t> allocated_ = 0;
    std::atomic<std::uint64_t> peak_ = 0;
};

// A buffer does not fit.
class OutOfDeviceMemory : public DeviceError
{
public:
    using DeviceError::DeviceError;
};

// "512 B", "1.5 MiB": binary units, one decimal.
std::string format_bytes(std::uint64_t bytes);

} // namespace sundog
