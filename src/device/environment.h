// Numbers that tests and bench scripts set through environment variables.
#pragma once

#include <cstdint>
#include <optional>

namespace sundog
{

// Value of the variable: a whole number > 0. Nothing when it is not set. Throws DeviceError for other text.
std::optional<std::uint64_t> environment_number(const char* name);

} // namespace sundog
