// sundog render SCENE.xml
#include "app/commands.h"
#include "app/option_values.h"
#include "app/render_results.h"
#include "base/file_lock.h"
#include "base/log.h"
#include "film/image_io.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace sundog {

namespace {

LoadedScene load(const RenderOptions& options, const RenderPlan& plan)
{
    const Timer timer;
    LoadedScene loaded = load_scene(options.scene, plan.load);
    check_scene_files_apart(options, plan, loaded.files);
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

ExitStatus render(const RenderOptions& options)
{
    const Timer wall;
    const RenderPlan plan = make_plan(options);
    std::optional<FileLock> lock;
    if (plan.checkpoint) lock.emplace(plan.checkpoint->file);
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
    save_results(session, options, plan, end, preview, wall);
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
    command->add_flag("--allow-missing", options->allow_missing, allow_missing_help);
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
