// sundog render SCENE.xml
#include "app/commands.h"
#include "app/option_values.h"
#include "app/statistics_json.h"
#include "base/atomic_file.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/timer.h"
#include "film/image_io.h"
#include "import/mitsuba_xml.h"
#include "methods/method.h"
#include "render/session.h"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>

namespace sundog {

namespace {

struct RenderOptions {
    std::string scene;
    std::vector<std::string> outputs;
    std::string method;
    std::vector<std::string> parameters; // KEY=VALUE
    std::vector<std::string> defines; // NAME=VALUE
    std::optional<std::string> iterations;
    std::optional<std::string> time;
    std::optional<std::string> seed;
    std::string size;
    std::string device;
    std::string exposure = "0";
    std::string progress;
    std::string stats;
    bool quiet = false;
    bool verbose = false;
};

// What has been checked before anything slow starts.
struct RenderPlan {
    std::vector<std::filesystem::path> outputs;
    float exposure_stops = 0.0f;
    RenderSettings settings;
    LoadOptions load;
    std::optional<std::uint64_t> iterations;
    std::optional<double> seconds;
    ProgressMode progress = ProgressMode::off;
};

ProgressMode choose_progress(const RenderOptions& options)
{
    if (options.progress.empty() && options.quiet) return ProgressMode::off;
    const auto mode = parse_progress_mode(options.progress.empty() ? "auto" : options.progress);
    if (!mode) throw UsageError("--progress must be auto, bar, plain, json or off, got \"" + options.progress + "\"");
    return *mode;
}

std::string default_output(const std::string& scene)
{
    const std::string endings = writable_endings();
    return std::filesystem::path(scene).stem().string() + (endings.starts_with(".exr") ? ".exr" : ".pfm");
}

RenderPlan make_plan(const RenderOptions& options)
{
    RenderPlan plan;
    plan.progress = choose_progress(options);
    plan.exposure_stops = static_cast<float>(parse_finite("--exposure", options.exposure));
    plan.load.defines = parse_assignments("-D", options.defines);
    plan.settings.method = options.method;
    plan.settings.parameters = parse_assignments("--param", options.parameters);
    if (options.seed) plan.settings.seed = parse_count("--seed", *options.seed);
    if (!options.size.empty()) plan.settings.size = parse_size(options.size);
    if (!options.method.empty() && !find_method(options.method)) throw UsageError("unknown method \"" + options.method + "\"; sundog methods lists them");
    if (options.iterations) plan.iterations = parse_count("--iterations", *options.iterations);
    if (plan.iterations == 0u) throw UsageError("--iterations must be at least 1");
    if (options.time) plan.seconds = parse_finite("--time", *options.time);
    if (plan.seconds && *plan.seconds <= 0.0) throw UsageError("--time must be more than 0 seconds");

    for (const std::string& output : options.outputs) plan.outputs.emplace_back(output);
    if (plan.outputs.empty()) plan.outputs.emplace_back(default_output(options.scene));
    for (const auto& output : plan.outputs) check_writable(output);
    if (!options.stats.empty()) check_file_writable(options.stats);
    return plan;
}

LoadedScene load(const RenderOptions& options, const RenderPlan& plan)
{
    const Timer timer;
    LoadedScene loaded = load_scene(options.scene, plan.load);
    for (const std::string& warning : loaded.warnings) log_warning(warning);
    log_debug(fmt::format("loaded {}: {} triangles, {:.2f} s", options.scene, loaded.scene.triangle_count(), timer.seconds()));
    return loaded;
}

// Iterates until the goal or Ctrl-C. Returns false when interrupted.
bool iterate(RenderSession& session, const RenderPlan& plan)
{
    ProgressGoal goal{plan.iterations, plan.seconds};
    if (!goal.iterations && !goal.seconds) goal.iterations = session.requested_iterations();
    Progress progress(plan.progress, goal, std::cerr, terminal_columns());
    set_before_log_line([&progress] { progress.clear(); });
    defer_interrupts();

    const Timer timer;
    progress.update(0, 0.0);
    bool finished = false;
    do {
        session.iterate();
        progress.update(session.iterations_done(), timer.seconds());
        finished = (goal.iterations && session.iterations_done() >= *goal.iterations) || (goal.seconds && timer.seconds() >= *goal.seconds);
    } while (!finished && !interrupt_requested());
    progress.finish(session.iterations_done(), timer.seconds());
    set_before_log_line({});
    return finished;
}

// Writes all that can be written, then reports the first failure: hours of rendering must not be lost to
// one full disk.
void write_outputs(const Image& image, const RenderPlan& plan)
{
    std::optional<FileError> failure;
    for (const auto& output : plan.outputs) {
        try {
            write_image(output, image, plan.exposure_stops);
        } catch (const FileError& error) {
            if (failure) log_error(error.what());
            else failure = error;
        }
    }
    if (failure) throw *failure;
}

std::string joined(const std::vector<std::filesystem::path>& paths)
{
    std::string text;
    for (const auto& path : paths) text += (text.empty() ? "" : ", ") + path.string();
    return text;
}

void log_statistics(const RenderStatistics& statistics)
{
    if (statistics.invalid_samples > 0) log_warning(fmt::format("{} invalid samples (NaN or infinite) were kept out of the image", statistics.invalid_samples));
    for (const auto& [stage, seconds] : statistics.stage_seconds) log_debug(fmt::format("{:8.3f} s  {}", seconds, stage));
    log_debug(fmt::format("kernels ready in {:.2f} s, peak device memory {:.1f} MB", statistics.kernel_build_seconds,
                          static_cast<double>(statistics.peak_device_bytes) * 1e-6));
}

ExitStatus render(const RenderOptions& options)
{
    const Timer wall;
    const RenderPlan plan = make_plan(options);
    if (options.quiet || (plan.progress == ProgressMode::json && !options.verbose)) set_log_level(LogLevel::warning);
    else if (options.verbose) set_log_level(LogLevel::debug);

    LoadedScene loaded = load(options, plan);
    Device device(select_device(options.device));
    log_debug("device: " + device.info().name);
    RenderSession session(std::move(loaded.scene), device, plan.settings);
    const bool finished = iterate(session, plan);

    write_outputs(session.image(), plan);
    const RenderStatistics statistics = session.statistics();
    log_statistics(statistics);
    if (!options.stats.empty()) write_file_atomically(options.stats, statistics_json(statistics, wall.seconds()).dump(2) + "\n");
    log_info(fmt::format("{}wrote {} ({}, {} iterations, {:.1f} s)", finished ? "" : "interrupted; ", joined(plan.outputs), statistics.method, statistics.iterations,
                         wall.seconds()));
    return finished ? ExitStatus::done : ExitStatus::interrupted;
}

} // namespace

void add_render_command(CLI::App& app, ExitStatus& status)
{
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "Render a scene");
    auto repeatable = [&](const std::string& names, std::vector<std::string>& target, const std::string& type, const std::string& help) {
        command->add_option(names, target, help + " (repeatable)")->type_name(type)->allow_extra_args(false);
    };
    command->add_option("SCENE", options->scene, "Mitsuba scene file")->required();
    repeatable("-o,--output", options->outputs, "FILE", "Image to write, " + writable_endings() + "; default: SCENE's name in the current folder");
    command->add_option("-m,--method", options->method, "Method, instead of the scene's <integrator>; sundog methods lists them")->type_name("NAME");
    repeatable("-p,--param", options->parameters, "KEY=VALUE", "Method parameter");
    repeatable("-D", options->defines, "NAME=VALUE", "Scene parameter, $NAME in the file");
    command->add_option("-n,--iterations", options->iterations, "Stop after so many iterations")->type_name("N");
    command->add_option("-t,--time", options->time, "Stop when so many seconds of rendering are over; with -n, whichever comes first")->type_name("SECONDS");
    command->add_option("-s,--seed", options->seed, "Seed of the random numbers, instead of the scene's")->type_name("N");
    command->add_option("--size", options->size, "Film size in pixels, instead of the scene's")->type_name("WxH");
    command->add_option("-d,--device", options->device, "OpenCL device: index, part of the name, cpu, gpu or all")->type_name("SELECTOR");
    command->add_option("--exposure", options->exposure, "Scale PNG by 2^STOPS")->type_name("STOPS");
    command->add_option("--progress", options->progress, "auto (a bar on a terminal, plain lines elsewhere), bar, plain, json or off")->type_name("MODE");
    command->add_option("--stats", options->stats, "Write counts and times as JSON")->type_name("FILE");
    command->add_flag("-q,--quiet", options->quiet, "Print warnings and errors only");
    command->add_flag("-v,--verbose", options->verbose, "Print what happens, and the time of each stage");
    command->callback([options, &status] { status = render(*options); });
}

} // namespace sundog
