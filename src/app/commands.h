// The subcommands. Each adds itself to the command line; when chosen, it runs and stores the exit status.
#pragma once

#include "base/errors.h"

#include <CLI/CLI.hpp>

namespace sundog {

void add_render_command(CLI::App& app, ExitStatus& status);
void add_devices_command(CLI::App& app, ExitStatus& status);
void add_methods_command(CLI::App& app, ExitStatus& status);
void add_info_command(CLI::App& app, ExitStatus& status);
void add_compare_command(CLI::App& app, ExitStatus& status);
void add_merge_command(CLI::App& app, ExitStatus& status);
void add_bench_command(CLI::App& app, ExitStatus& status);

} // namespace sundog
