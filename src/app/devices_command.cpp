// sundog devices
#include "app/commands.h"
#include "device/device.h"

#include <fmt/format.h>

#include <iostream>

namespace sundog {

namespace {

std::string gibibytes(std::uint64_t bytes) { return fmt::format("{:.1f} GiB", static_cast<double>(bytes) / (1024.0 * 1024.0 * 1024.0)); }

const char* kind_of(const DeviceInfo& info) { return info.is_gpu ? "GPU" : info.is_cpu ? "CPU" : "accelerator"; }

// What Sundog does with the device; opening it may fail.
std::string use_of(const DeviceInfo& info)
{
    try {
        const Device device(info);
        return fmt::format("work-groups of {}, {} 64-bit atomics", device.work_group_size(), info.has_int64_atomics ? "with" : "without");
    } catch (const DeviceError& error) {
        return std::string("cannot be used: ") + error.what();
    }
}

void print_device(const DeviceInfo& info)
{
    std::cout << fmt::format("{}: {} ({})\n", info.index, info.name, kind_of(info));
    std::cout << fmt::format("   platform       {}, {}\n", info.platform, info.version);
    std::cout << fmt::format("   driver         {}\n", info.driver);
    std::cout << fmt::format("   compute units  {}\n", info.compute_units);
    std::cout << fmt::format("   memory         {}{}, buffers of up to {}\n", gibibytes(info.memory_bytes), info.unified_memory ? " shared with the host" : "",
                             gibibytes(info.largest_buffer_bytes));
    std::cout << fmt::format("   used with      {}\n", use_of(info));
}

ExitStatus devices()
{
    const DeviceInfo chosen = select_device(""); // throws, with the cure, when there is none
    for (const DeviceInfo& info : list_devices()) print_device(info);
    std::cout << fmt::format("Without --device, Sundog renders on {}: {}\n", chosen.index, chosen.name);
    return ExitStatus::done;
}

} // namespace

void add_devices_command(CLI::App& app, ExitStatus& status)
{
    CLI::App* command = app.add_subcommand("devices", "List every OpenCL device, with what Sundog will use of it");
    command->callback([&status] { status = devices(); });
}

} // namespace sundog
