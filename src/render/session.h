// A render from start to image: scene and method on a device, iteration after iteration.
#pragma once

#include "device/device.h"
#include "film/error_estimate.h"
#include "film/image.h"
#include "methods/method.h"
#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace sundog {

// The error of the image is to be estimated.
struct ErrorSettings {
    double confidence = 0.9; // of bounds, in (0, 1)
};

// What the command line (or a library user) asks for beyond the scene file.
struct RenderSettings {
    std::string method; // empty: the scene's <integrator>, else "sppm"
    std::map<std::string, std::string> parameters; // as with --param; they override the scene's
    std::optional<std::uint64_t> seed; // else the scene's
    std::optional<std::pair<int, int>> size; // film size in pixels, instead of the scene's
    std::optional<ErrorSettings> errors;
};

struct RenderStatistics {
    std::string method;
    std::vector<std::pair<std::string, std::string>> parameters;
    std::uint64_t seed = 0;
    std::string device;
    std::uint64_t iterations = 0; // with those of a checkpoint, as are counters, render and stage seconds
    std::uint64_t resumed_iterations = 0; // of them, done before this session
    MethodCounters counters;
    double render_seconds = 0.0; // wall time in iterate()
    double kernel_build_seconds = 0.0;
    std::vector<std::pair<std::string, double>> stage_seconds; // label, device time
    std::uint64_t peak_device_bytes = 0;
    std::optional<RelativeError> error; // where it is estimated
    double error_confidence = 0.0; // of its bound
    std::uint64_t invalid_samples = 0; // NaN or infinite, kept out of the image
};

class RenderSession {
public:
    // Validates method and parameters, builds the acceleration structure, uploads the scene, builds
    // kernels. Throws UsageError, SceneError or DeviceError.
    RenderSession(Scene scene, Device& device, const RenderSettings& settings);
    ~RenderSession();

    // Iterations that the scene or the method's `iterations` parameter asks for (at least 1).
    std::uint64_t requested_iterations() const;

    // How far the image is from the truth, as far as that is known; waits. Only where settings ask for errors.
    RelativeError relative_error() const;
    const MethodInfo& method() const;

    // Renders one iteration and waits for it. Where that throws, what was done before it is still there: an image, and
    // a checkpoint where can_be_saved().
    void iterate();
    std::uint64_t iterations_done() const; // with those of a checkpoint

    // False once an iteration has failed while it was changing what iterations add up to.
    bool can_be_saved() const;

    // Saves all that iterations have added up to FILE, whole or not at all. At least one must be done. Throws FileError.
    void save_checkpoint(const std::filesystem::path& file) const;

    // Goes on where FILE was saved, instead of a first iteration: what follows is, bit for bit, what would have followed
    // there (on the same device; on another one, with a warning, it is as good). Throws FileError when FILE is
    // damaged, or is of another scene, method, parameter, seed or size; the session is of no use then.
    void resume(const std::filesystem::path& file);

    // The image so far, with AOV channels and metadata. At least one iteration must be done.
    Image image() const;
    RenderStatistics statistics() const;
    const Scene& scene() const;
    int width() const; // pixels of the image (the crop)
    int height() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace sundog
