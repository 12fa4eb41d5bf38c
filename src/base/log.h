// Messages to the user on stderr. Errors are exceptions; these are what goes on beside.
#pragma once

#include <functional>
#include <string_view>

namespace sundog
{

enum class LogLevel { quiet, warning, info, debug };

// Messages above the level are dropped. At the start: warning.
void set_log_level(LogLevel level);
LogLevel log_level();

// "sundog: warning: MESSAGE", "sundog: MESSAGE", "sundog: debug: MESSAGE"; each one line, from any thread.
// "sundog: error: MESSAGE", at every level. Only the first line of a message of several (a build log
// follows) is the error; the rest is printed at level debug.
void log_error(std::string_view message);
void log_warning(std::string_view message);
void log_info(std::string_view message);
void log_debug(std::string_view message);

// While it lives, `action` is called before each line that is printed, so that a progress bar can clear itself. One at a time.
class BeforeLogLine
{
public:
    explicit BeforeLogLine(std::function<void()> action);
    BeforeLogLine(const BeforeLogLine&) = delete;
    BeforeLogLine& operator=(const BeforeLogLine&) = delete;
    ~BeforeLogLine();
};

} // namespace sundog
