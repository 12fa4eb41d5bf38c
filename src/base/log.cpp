#include "base/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

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

void log_warning(std::string_view message)
{
    logger().warn("warning: {}", message);
}
void log_info(std::string_view message)
{
    logger().info("{}", message);
}
void log_debug(std::string_view message)
{
    logger().debug("debug: {}", message);
}

} // namespace sundog
