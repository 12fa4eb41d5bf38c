#include "device/memory_account.h"

#include <fmt/format.h>

#include <array>

namespace sundog
{

bool MemoryAccount::reserve(std::uint64_t bytes)
{
    if (bytes > largest_buffer_) return false;
    std::uint64_t before = allocated_.load();
    do {
        if (before > total_ || bytes > total_ - before) return false;
    } while (!allocated_.compare_exchange_weak(before, before + bytes));
    std::uint64_t now = before + bytes, highest = peak_.load();
    while (highest < now && !peak_.compare_exchange_weak(highest, now)) {
    }
    return true;
}

void MemoryAccount::release(std::uint64_t bytes)
{
    allocated_ -= bytes;
}

std::string MemoryAccount::describe() const
{
    return fmt::format("Sundog has {} in buffers; the device has {} and allows {} in one buffer", format_bytes(allocated_),
                       format_bytes(total_), format_bytes(largest_buffer_));
}

std::string format_bytes(std::uint64_t bytes)
{
    static constexpr std::array units = {"KiB", "MiB", "GiB", "TiB"};
    if (bytes < 1024) return fmt::format("{} B", bytes);
    double scaled = double(bytes) / 1024.0;
    std::size_t unit = 0;
    while (scaled >= 1024.0 && unit + 1 < units.size()) {
        scaled /= 1024.0;
        ++unit;
    }
    return fmt::format("{:.1f} {}", scaled, units[unit]);
}

} // namespace sundog
