// Messages to the user on stderr. Errors are exceptions; these are what goes on beside.
#pragma once

#include <string_view>

namespace sundog
{

enum class LogLevel { quiet, warning, info, debug };

// Messages above the level are dropped. At the start: warning.
void set_log_level(LogLevel level);
LogLevel log_level();

// "sundog: warning: MESSAGE", "sundog: MESSAGE", "sundog: debug: MESSAGE"; each one line, from any thread.
void log_warning(std::string_view message);
void log_info(std::string_view message);
void log_debug(std::string_view message);

} // namespace sundog
