// What `sundog render` is asked to do.
#pragma once

#include "base/progress.h"
#include "import/mitsuba_xml.h"
#include "render/live_preview.h"
#include "render/session.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sundog {

// As on the command line.
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
    bool allow_missing = false;
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

// Throws UsageError for what cannot be meant, and FileError for outputs that cannot be written.
RenderPlan make_plan(const RenderOptions& options);

// Throws UsageError where an output is one of the files that the scene has named. Nothing has been written yet.
void check_scene_files_apart(const RenderOptions& options, const RenderPlan& plan, const std::vector<std::filesystem::path>& files);

} // namespace sundog
