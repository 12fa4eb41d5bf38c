#include "base/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <functional>
#include <mutex>
#include <string>
#include <utility>

namespace sundog
{

namespace
{

spdlog::logger& logger()
{
    static spdlog::logger instance = [] {
        spdlog::logger made("sundog", std::make_shared<spdlog::sinks::stderr_sink_mt>());
        made.set_pattern("sundog: %v");
        made.set_level(spdlog::level::warn);
        return made;
    }();
    return instance;
}

// Lines come from any thread: none of them may use the action of a display that has ended.
struct BeforeLine {
    std::mutex mutex;
    std::function<void()> action;
};

BeforeLine& before_line()
{
    static BeforeLine instance;
    return instance;
}

void set_before_line(std::function<void()> action)
{
    std::lock_guard lock(before_line().mutex);
    before_line().action = std::move(action);
}

void print(spdlog::level::level_enum level, std::string_view kind, std::string_view message)
{
    if (!logger().should_log(level)) return;
    std::lock_guard lock(before_line().mutex);
    if (before_line().action) before_line().action();
    logger().log(level, "{}{}", kind, message);
}

} // namespace

void set_log_level(LogLevel level)
{
    switch (level) {
    case LogLevel::quiet:
        logger().set_level(spdlog::level::off);
        break;
    case LogLevel::warning:
        logger().set_level(spdlog::level::warn);
        break;
    case LogLevel::info:
        logger().set_level(spdlog::level::info);
        break;
    case LogLevel::debug:
        logger().set_level(spdlog::level::debug);
        break;
    }
}

LogLevel log_level()
{
    switch (logger().level()) {
    case spdlog::level::debug:
        return LogLevel::debug;
    case spdlog::level::info:
        return LogLevel::info;
    case spdlog::level::warn:
        return LogLevel::warning;
    default:
        return LogLevel::quiet;
    }
}

void log_error(std::string_view message)
{
    const auto end = message.find('\n');
    const bool cut = end != std::string_view::npos && end + 1 < message.size();
    const bool hidden = cut && log_level() != LogLevel::debug;
    print(spdlog::level::err, "error: ", std::string(message.substr(0, end)) + (hidden ? " (-v shows more)" : ""));
    if (cut) log_debug(message.substr(end + 1));
}

void log_warning(std::string_view message) { print(spdlog::level::warn, "warning: ", message); }
void log_info(std::string_view message) { print(spdlog::level::info, "", message); }
void log_debug(std::string_view message) { print(spdlog::level::debug, "debug: ", message); }

BeforeLogLine::BeforeLogLine(std::function<void()> action) { set_before_line(std::move(action)); }

BeforeLogLine::~BeforeLogLine() { set_before_line({}); }

} // namespace sundog
