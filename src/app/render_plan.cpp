#include "app/render_plan.h"

#include "app/option_values.h"
#include "app/output_conflicts.h"
#include "base/atomic_file.h"
#include "base/errors.h"
#include "base/interrupt.h"
#include "film/image_io.h"
#include "methods/method.h"

namespace sundog {

namespace {

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
    plan.error_image = options.error_image;
    if (options.errors || plan.target_error || !plan.error_image.empty()) plan.settings.errors = ErrorSettings{};
    if (!options.error_confidence) return;
    const double confidence = parse_finite("--error-confidence", *options.error_confidence);
    if (confidence <= 0.0 || confidence >= 1.0)
        throw UsageError("--error-confidence must lie between 0 and 1, such as 0.9, got \"" + *options.error_confidence + "\"");
    if (!plan.settings.errors) throw UsageError("--error-confidence needs --errors, --error-image FILE or --target-error E");
    plan.settings.errors->confidence = confidence;
}

std::vector<NamedFile> outputs_of(const RenderOptions& options, const RenderPlan& plan)
{
    std::vector<NamedFile> outputs;
    for (const auto& output : plan.outputs) outputs.push_back({"-o", output});
    if (!plan.error_image.empty()) outputs.push_back({"--error-image", plan.error_image});
    if (!options.stats.empty()) outputs.push_back({"--stats", options.stats});
    if (plan.checkpoint) outputs.push_back({"--checkpoint", plan.checkpoint->file});
    const auto& parameters = plan.settings.parameters;
    if (const auto map = parameters.find("save_map"); map != parameters.end()) outputs.push_back({"save_map", map->second});
    return outputs;
}

// Before anything is read or written.
void check_files_apart(const RenderOptions& options, const RenderPlan& plan)
{
    std::vector<NamedFile> inputs{{"the scene", options.scene}};
    const auto& parameters = plan.settings.parameters;
    if (const auto map = parameters.find("load_map"); map != parameters.end()) inputs.push_back({"the photon maps", map->second});
    check_outputs_apart(inputs, outputs_of(options, plan));
}

void check_all_writable(const RenderOptions& options, const RenderPlan& plan)
{
    for (const auto& output : plan.outputs) check_writable(output);
    if (!plan.error_image.empty()) check_writable(plan.error_image);
    if (!options.stats.empty()) check_file_writable(options.stats);
    if (plan.checkpoint) check_file_replaceable(plan.checkpoint->file);
}

} // namespace

RenderPlan make_plan(const RenderOptions& options)
{
    RenderPlan plan;
    plan.progress = choose_progress(options);
    plan.exposure_stops = static_cast<float>(parse_finite("--exposure", options.exposure));
    plan.load.defines = parse_assignments("-D", options.defines);
    plan.load.allow_missing = options.allow_missing;
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
    check_files_apart(options, plan);
    check_all_writable(options, plan);
    return plan;
}

void check_scene_files_apart(const RenderOptions& options, const RenderPlan& plan, const std::vector<std::filesystem::path>& files)
{
    std::vector<NamedFile> inputs;
    for (const auto& file : files) inputs.push_back({"a file that the scene reads", file});
    check_outputs_apart(inputs, outputs_of(options, plan));
}

} // namespace sundog
