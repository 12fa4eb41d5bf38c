#include "base/fault_injection.h"

#include "base/errors.h"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string_view>

namespace sundog {

namespace {

constexpr std::array<std::string_view, 5> point_names{"iterate", "accumulate", "image", "checkpoint", "preview"};

[[noreturn]] void fail(std::string_view kind)
{
    if (kind == "memory") throw std::bad_alloc();
    if (kind == "device") throw DeviceError("this fault was asked for by SUNDOG_FAULT");
    if (kind == "file") throw FileError("this fault was asked for by SUNDOG_FAULT");
    throw std::runtime_error("this fault was asked for by SUNDOG_FAULT");
}

} // namespace

void fault_point(FaultPoint point)
{
    static const char* const wanted = std::getenv("SUNDOG_FAULT");
    if (!wanted) return;
    static std::array<std::atomic<std::uint64_t>, point_names.size()> calls{};
    const auto index = static_cast<std::size_t>(point);
    const std::string_view text = wanted;
    const auto colon = text.find(':');
    if (colon == std::string_view::npos || text.substr(0, colon) != fmt::format("{}@{}", point_names[index], ++calls[index])) return;
    fail(text.substr(colon + 1));
}

} // namespace sundog
