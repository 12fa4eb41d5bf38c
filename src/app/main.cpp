// The command line: chooses a subcommand, and turns what went wrong into one line and an exit status.
#include "app/commands.h"
#include "app/failure.h"
#include "base/interrupt.h"
#include "base/log.h"

#include <algorithm>
#include <iostream>

namespace sundog {
namespace {

std::vector<const CLI::App*> all_commands(const CLI::App& app)
{
    return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string command_names(const CLI::App& app)
{
    std::string names;
    for (const CLI::App* command : all_commands(app)) names += (names.empty() ? "" : ", ") + command->get_name();
    return names;
}

// CLI11 would take a misspelt command for a missing one.
void check_command(const CLI::App& app, int argc, char** argv)
{
    if (argc < 2 || argv[1][0] == '-') return;
    const std::string name = argv[1];
    const auto commands = all_commands(app);
    if (std::none_of(commands.begin(), commands.end(), [&](const CLI::App* command) { return command->get_name() == name; }))
        throw UsageError("unknown command \"" + name + "\"; the commands are " + command_names(app));
}

[[noreturn]] void throw_usage_error(const CLI::App& app, const CLI::ParseError& error)
{
    std::string help = "sundog";
    for (const CLI::App* command : app.get_subcommands()) help += " " + command->get_name();
    throw UsageError(std::string(error.what()) + "; see " + help + " --help");
}

ExitStatus run(int argc, char** argv)
{
    CLI::App app("Sundog: photon-density rendering on OpenCL devices", "sundog");
    app.set_version_flag("--version", "sundog " SUNDOG_VERSION);
    app.require_subcommand(1);
    ExitStatus status = ExitStatus::done;
    add_render_command(app, status);
    add_devices_command(app, status);
    add_methods_command(app, status);
    add_info_command(app, status);
    add_compare_command(app, status);
    add_merge_command(app, status);
    add_bench_command(app, status);
    if (argc < 2) throw UsageError("no command given; the commands are " + command_names(app) + "; see sundog --help");
    check_command(app, argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) throw_usage_error(app, error);
        app.exit(error); // prints help or the version
    }
    if (!std::cout.flush()) throw FileError("cannot write to standard output");
    return status;
}

// Every exception ends here.
ExitStatus run_guarded(int argc, char** argv)
{
    try {
        return run(argc, argv);
    } catch (...) {
        const Failure failure = failure_of(std::current_exception());
        log_error(failure.message);
        return failure.status;
    }
}

} // namespace
} // namespace sundog

int main(int argc, char** argv)
{
    sundog::install_interrupt_handler();
    sundog::set_log_level(sundog::LogLevel::info);
    return static_cast<int>(sundog::run_guarded(argc, argv));
}
