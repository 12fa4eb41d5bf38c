#include "device/environment.h"

#include "base/errors.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

namespace sundog
{

std::optional<std::uint64_t> environment_number(const char* name)
{
    const char* value = std::getenv(name);
    if (!value || !*value) return {};
    const std::string_view text = value;
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number == 0)
        throw DeviceError(fmt::format("environment variable {} must be a whole number > 0, got '{}'", name, text));
    return number;
}

} // namespace sundog
