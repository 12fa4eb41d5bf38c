// sundog render SCENE.xml
#include "app/commands.h"
#include "app/option_values.h"
#include "app/statistics_json.h"
#include "base/atomic_file.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/timer.h"
#include "film/heat_map.h"
#include "film/image_io.h"
#include "import/mitsuba_xml.h"
#include "methods/method.h"
#include "render/live_preview.h"
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
    std::optional<std::string> texture_memory; // MB
    std::string progress;
    std::string stats;
    std::string checkpoint;
    std::optional<std::string> checkpoint_every;
    bool resume = false;
    bool errors = false;
    std::optional<std::string> target_error;
    std::optional<std::string> error_confidence;
    std::string error_image;
    std::string preview;
    bool quiet = false;
    bool verbose = false;
};

constexpr double default_checkpoint_seconds = 600.0;

struct CheckpointPlan {
    std::filesystem::path file;
    double interval = default_checkpoint_seconds; // s
    bool resume = false;
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
    std::optional<CheckpointPlan> checkpoint;
    std::optional<double> target_error;
    std::filesystem::path error_image; // empty: none
    std::optional<PreviewAddress> preview;
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

std::optional<CheckpointPlan> plan_checkpoint(const RenderOptions& options)
{
    if (options.checkpoint.empty()) {
        if (options.resume) throw UsageError("--resume needs --checkpoint FILE, the file to resume from");
        if (options.checkpoint_every) throw UsageError("--checkpoint-every needs --checkpoint FILE, the file to save to");
        return std::nullopt;
    }
    CheckpointPlan plan{options.checkpoint, default_checkpoint_seconds, options.resume};
    if (options.checkpoint_every) plan.interval = parse_finite("--checkpoint-every", *options.checkpoint_every);
    if (plan.interval <= 0.0) throw UsageError("--checkpoint-every must be more than 0 seconds");
    return plan;
}

void plan_errors(const RenderOptions& options, RenderPlan& plan)
{
    if (options.target_error) {
        plan.target_error = parse_finite("--target-error", *options.target_error);
        if (*plan.target_error <= 0.0)
            throw UsageError("--target-error must be more than 0, such as 0.05 for 5 percent, got \"" + *options.target_error + "\"");
    }
    if (!options.error_image.empty()) {
        plan.error_image = options.error_image;
        check_writable(plan.error_image);
    }
    if (options.errors || plan.target_error || !plan.error_image.empty()) plan.settings.errors = ErrorSettings{};
    if (!options.error_confidence) return;
    const double confidence = parse_finite("--error-confidence", *options.error_confidence);
    if (confidence <= 0.0 || confidence >= 1.0)
        throw UsageError("--error-confidence must lie between 0 and 1, such as 0.9, got \"" + *options.error_confidence + "\"");
    if (!plan.settings.errors) throw UsageError("--error-confidence needs --errors, --error-image FILE or --target-error E");
    plan.settings.errors->confidence = confidence;
}

RenderPlan make_plan(const RenderOptions& options)
{
    RenderPlan plan;
    plan.progress = choose_progress(options);
    plan.exposure_stops = static_cast<float>(parse_finite("--exposure", options.exposure));
    plan.load.defines = parse_assignments("-D", options.defines);
    if (options.texture_memory) plan.load.texture_bytes = parse_megabytes("--texture-memory", *options.texture_memory);
    plan.settings.method = options.method;
    plan.settings.parameters = parse_assignments("--param", options.parameters);
    plan.settings.stop_requested = interrupt_requested;
    if (options.seed) plan.settings.seed = parse_count("--seed", *options.seed);
    if (!options.size.empty()) plan.settings.size = parse_size(options.size);
    if (!options.method.empty() && !find_method(options.method)) throw UsageError("unknown method \"" + options.method + "\"; sundog methods lists them");
    if (options.iterations) plan.iterations = parse_count("--iterations", *options.iterations);
    if (plan.iterations == 0u) throw UsageError("--iterations must be at least 1");
    if (options.time) plan.seconds = parse_finite("--time", *options.time);
    if (plan.seconds && *plan.seconds <= 0.0) throw UsageError("--time must be more than 0 seconds");
    plan.checkpoint = plan_checkpoint(options);
    plan_errors(options, plan);
    if (!options.preview.empty()) {
        const auto [host, port] = parse_address("--preview", options.preview);
        plan.preview = PreviewAddress{host, port};
    }

    for (const std::string& output : options.outputs) plan.outputs.emplace_back(output);
    if (plan.outputs.empty()) plan.outputs.emplace_back(default_output(options.scene));
    for (const auto& output : plan.outputs) check_writable(output);
    if (!options.stats.empty()) check_file_writable(options.stats);
    if (plan.checkpoint) check_file_writable(plan.checkpoint->file);
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

// Continues from the checkpoint, if that is asked for and there is one.
void resume(RenderSession& session, const CheckpointPlan& checkpoint, std::optional<std::uint64_t> goal)
{
    const std::string name = checkpoint.file.string();
    const bool exists = std::filesystem::exists(checkpoint.file);
    if (!checkpoint.resume) {
        if (exists) log_warning(name + " will be replaced: without --resume the render starts afresh");
    } else if (!exists) {
        log_info("there is no " + name + " yet; starting afresh");
    } else {
        session.resume(checkpoint.file);
        log_info(fmt::format("resumed from {} after {} iterations", name, session.iterations_done()));
        if (goal && session.iterations_done() > *goal)
            log_warning(fmt::format("{} already holds {} iterations, more than the {} asked for", name, session.iterations_done(), *goal));
    }
}

// Saves a checkpoint whenever it is time to. One that cannot be saved is not the end of the render.
class CheckpointSchedule {
public:
    explicit CheckpointSchedule(const std::optional<CheckpointPlan>& plan) : plan_(plan) {}
    void update(const RenderSession& session)
    {
        if (!plan_ || since_last_.seconds() < plan_->interval) return;
        try {
            session.save_checkpoint(plan_->file);
        } catch (const FileError& error) {
            log_warning(fmt::format("no checkpoint now: {}", error.what()));
        }
        since_last_ = Timer();
    }

private:
    const std::optional<CheckpointPlan>& plan_;
    Timer since_last_;
};

// Asks now and then whether the error is small enough. Bounds of few iterations say little, and each question costs a
// pass over the film: the first comes after 8 iterations, the others when there are a sixteenth more. A resumed render
// asks after the same iterations as an uninterrupted one, and so ends with the same.
class ErrorWatch {
public:
    ErrorWatch(std::optional<double> target, std::uint64_t iterations_done) : target_(target)
    {
        while (next_ < iterations_done) next_ = after(next_);
    }
    void update(const RenderSession& session, Progress& progress)
    {
        if (!target_ || session.iterations_done() < next_) return;
        const double bound = session.relative_error().bound;
        progress.set_error(session.iterations_done(), bound);
        met_ = bound <= *target_;
        next_ = after(next_);
    }
    bool met() const { return met_; }

private:
    static std::uint64_t after(std::uint64_t iterations) { return iterations + std::max<std::uint64_t>(1, iterations / 16); }

    std::optional<double> target_;
    std::uint64_t next_ = 8;
    bool met_ = false;
};

ProgressGoal goal_of(const RenderSession& session, const RenderPlan& plan)
{
    ProgressGoal goal{plan.iterations, plan.seconds, session.iterations_done(), std::nullopt};
    // The error of photon maps falls as N^(-1/3), a square root of N^(-2/3) (docs/errors.md).
    if (plan.target_error && session.method().estimator_class == "biased" && !goal.iterations && !goal.seconds)
        throw UsageError(fmt::format("{} keeps a bias however long it renders, and may never reach --target-error; give -n or -t as well", session.method().name));
    if (plan.target_error) goal.error = ErrorGoal{*plan.target_error, session.method().estimator_class == "unbiased" ? 1.0 / 2 : 1.0 / 3};
    if (!goal.iterations && !goal.seconds && !goal.error) goal.iterations = session.requested_iterations();
    return goal;
}

struct IterationsEnd {
    bool finished; // rather than interrupted
    bool error_met;
};

// Iterates until a goal or Ctrl-C.
IterationsEnd iterate(RenderSession& session, const RenderPlan& plan, std::optional<LivePreview>& preview)
{
    const ProgressGoal goal = goal_of(session, plan);
    Progress progress(plan.progress, goal, std::cerr, terminal_columns());
    set_before_log_line([&progress] { progress.clear(); });
    defer_interrupts();

    const Timer timer;
    CheckpointSchedule checkpoints(plan.checkpoint);
    ErrorWatch error(plan.target_error, session.iterations_done());
    error.update(session, progress); // of a checkpoint
    progress.update(session.iterations_done(), 0.0);
    const auto finished = [&] {
        return error.met() || (goal.iterations && session.iterations_done() >= *goal.iterations) || (goal.seconds && timer.seconds() >= *goal.seconds);
    };
    // At least one, so that there is an image.
    while (session.iterations_done() == 0 || (!finished() && !interrupt_requested())) {
        try {
            session.iterate();
        } catch (const Interrupted&) {
            if (session.iterations_done() == 0) throw;
            break;
        }
        error.update(session, progress);
        progress.update(session.iterations_done(), timer.seconds());
        checkpoints.update(session);
        if (preview) preview->update(session);
    }
    progress.finish(session.iterations_done(), timer.seconds());
    set_before_log_line({});
    return {finished(), error.met()};
}

// Saves all that can be saved, then reports the first failure: hours of rendering must not be lost to one full disk.
void save_all(const RenderSession& session, const Image& image, const RenderPlan& plan)
{
    std::optional<FileError> failure;
    const auto attempt = [&](auto save) {
        try {
            save();
        } catch (const FileError& error) {
            if (failure) log_error(error.what());
            else failure = error;
        }
    };
    for (const auto& output : plan.outputs) attempt([&] { write_image(output, image, plan.exposure_stops); });
    if (!plan.error_image.empty()) attempt([&] { write_image(plan.error_image, heat_map(image)); });
    if (plan.checkpoint) attempt([&] { session.save_checkpoint(plan.checkpoint->file); });
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
    if (statistics.stage_seconds.empty()) log_debug("seconds of stages: not known, the driver's times do not agree with the clock");
    for (const auto& [stage, seconds] : statistics.stage_seconds) log_debug(fmt::format("{:8.3f} s  {}", seconds, stage));
    log_debug(fmt::format("kernels ready in {:.2f} s, peak device memory {:.1f} MB", statistics.kernel_build_seconds,
                          static_cast<double>(statistics.peak_device_bytes) * 1e-6));
}

void log_error_bound(const RenderStatistics& statistics, const RenderPlan& plan, const std::optional<ErrorTarget>& target)
{
    if (!statistics.error) return;
    log_info(fmt::format("relative error at most {:.3g} with {:g}% confidence, about {:.3g} expected (noise {:.3g}, bias {:.3g})", statistics.error->bound,
                         100.0 * statistics.error_confidence, statistics.error->expected(), statistics.error->noise, statistics.error->bias));
    if (!plan.error_image.empty()) log_info(fmt::format("{}: {}", plan.error_image.string(), heat_map_legend()));
    if (target && !target->met && !interrupt_requested())
        log_warning(fmt::format("stopped before --target-error {:g} was reached; give it more iterations (-n) or time (-t)", target->error));
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
    if (plan.checkpoint) resume(session, *plan.checkpoint, plan.iterations);
    std::optional<LivePreview> preview;
    if (plan.preview) preview.emplace(*plan.preview, plan.outputs.front().filename().string());
    const IterationsEnd end = iterate(session, plan, preview);

    const Image image = session.image();
    save_all(session, image, plan);
    if (preview) preview->finish(image);
    const RenderStatistics statistics = session.statistics();
    log_statistics(statistics);
    std::optional<ErrorTarget> target;
    if (plan.target_error) target = ErrorTarget{*plan.target_error, end.error_met || statistics.error->bound <= *plan.target_error};
    log_error_bound(statistics, plan, target);
    if (!options.stats.empty()) write_file_atomically(options.stats, statistics_json(statistics, wall.seconds(), target).dump(2) + "\n");
    log_info(fmt::format("{}wrote {} ({}, {} iterations, {:.1f} s)", end.finished ? "" : "interrupted; ", joined(plan.outputs), statistics.method, statistics.iterations,
                         wall.seconds()));
    return end.finished ? ExitStatus::done : ExitStatus::interrupted;
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
    command->add_option("-n,--iterations", options->iterations, "Stop after so many iterations, those of a resumed checkpoint included")->type_name("N");
    command->add_option("-t,--time", options->time, "Stop after so many seconds of rendering in this run; with -n, whichever comes first")->type_name("SECONDS");
    command->add_option("-s,--seed", options->seed, "Seed of the random numbers, instead of the scene's")->type_name("N");
    command->add_option("--size", options->size, "Film size in pixels, instead of the scene's")->type_name("WxH");
    command->add_option("-d,--device", options->device, "OpenCL device: index, part of the name, cpu, gpu or all")->type_name("SELECTOR");
    command->add_option("--texture-memory", options->texture_memory, "Budget for bitmaps, default 1024; larger ones are scaled down, with a warning")->type_name("MB");
    command->add_option("--exposure", options->exposure, "Scale PNG by 2^STOPS")->type_name("STOPS");
    command->add_option("--progress", options->progress, "auto (a bar on a terminal, plain lines elsewhere), bar, plain, json or off")->type_name("MODE");
    command->add_option("--stats", options->stats, "Write counts and times as JSON")->type_name("FILE");
    command->add_option("--checkpoint", options->checkpoint, "Save all state to this file now and then, at the end, and at Ctrl-C")->type_name("FILE");
    command->add_option("--checkpoint-every", options->checkpoint_every, fmt::format("Seconds between checkpoints, default {:g}", default_checkpoint_seconds))
        ->type_name("SECONDS");
    command->add_flag("--resume", options->resume, "Go on from the checkpoint, or start afresh when there is none yet");
    command->add_flag("--errors", options->errors, "Estimate the error of every pixel: adds error.* and bias.* to EXR, and error to --stats");
    command->add_option("--target-error", options->target_error,
                        "Stop when the relative error, rms over the image, is at most E (0.05: 5 percent) at --error-confidence; with -n or -t, whichever comes first")
        ->type_name("E");
    command->add_option("--error-confidence", options->error_confidence, "Probability with which a pixel's error is within its bound, default 0.9")->type_name("P");
    command->add_option("--error-image", options->error_image, "Write a heat map of every pixel's relative error bound")->type_name("FILE");
    command->add_option("--preview", options->preview, "Show the image in a tev viewer while it renders; tev's own port is 14158")->type_name("HOST:PORT");
    command->add_flag("-q,--quiet", options->quiet, "Print warnings and errors only");
    command->add_flag("-v,--verbose", options->verbose, "Print what happens, and the time of each stage");
    command->footer("A resumed render is the uninterrupted one, bit for bit, on the same device: the same command can be given again until it\n"
                    "ends with status 0 (an interrupted one ends with 130). A checkpoint of another scene, method, parameter, seed or size, and\n"
                    "one that is damaged, is refused with status 5. Only the goal may change: -n, -t and the parameter iterations.");
    command->callback([options, &status] { status = render(*options); });
}

} // namespace sundog
