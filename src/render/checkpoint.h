// What a checkpoint says of its render, before the state itself: which render it is, and how far.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sundog {

// Two renders with the same identity give the same iterations.
struct RenderIdentity {
    std::string version; // of sundog
    std::string method;
    std::vector<std::pair<std::string, std::string>> parameters; // but not `iterations`, which is a goal, nor `save_map`, an output
    std::uint64_t seed = 0;
    int width = 0; // pixels of the image
    int height = 0;
    std::string scene_file; // for messages only
    std::string scene; // fingerprint
    bool errors = false; // whether they are estimated
};

struct RenderProgress {
    std::string device;
    std::uint64_t iterations = 0;
    double seconds = 0.0; // of rendering
    std::vector<std::pair<std::string, double>> stage_seconds;
};

std::string checkpoint_text(const RenderIdentity& identity, const RenderProgress& progress);

// Throws FileError, naming `file` and the first thing that differs, unless the text is that of a checkpoint of
// this very render.
RenderProgress progress_of_same_render(const std::string& text, const RenderIdentity& wanted, const std::filesystem::path& file);

} // namespace sundog
