#include "render/session.h"

#include "base/checkpoint_file.h"
#include "base/fault_injection.h"
#include "base/kept_values.h"
#include "base/log.h"
#include "base/timer.h"
#include "device/profile.h"
#include "methods/render_context.h"
#include "methods/standard_parameters.h"
#include "render/checkpoint.h"
#include "scene/fingerprint.h"
#include "scene/flat_scene.h"
#include "shared/film.h"
#include "stages/scene_motion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>

namespace sundog {

namespace {

constexpr const char* default_method = "sppm";
constexpr std::uint64_t default_iterations = 64;
constexpr std::uint64_t most_description_bytes = 1 << 20; // of a checkpoint

const MethodInfo& choose_method(const Scene& scene, const RenderSettings& settings)
{
    const bool from_scene = settings.method.empty() && !scene.integrator.method.empty();
    const std::string name = from_scene ? scene.integrator.method : settings.method.empty() ? default_method : settings.method;
    if (const MethodInfo* info = find_method(name)) return *info;
    std::vector<std::string> known;
    for (const MethodInfo* info : all_methods()) known.push_back(info->name);
    const std::string message = fmt::format("there is no method '{}'; choose one of {} (-m NAME)", name, fmt::join(known, ", "));
    if (from_scene) throw SceneError(scene.integrator.where, message);
    throw UsageError(message);
}

void check_motion(const Scene& scene, const MethodInfo& method, const Parameters& parameters)
{
    if (!scene.moves()) return;
    std::string which = method.follows_motion ? "" : method.name;
    for (const auto& [name, value] : method.motion_excludes)
        if (parameters.text(name) == value) which = fmt::format("{} with {}={}", method.name, name, value);
    if (!which.empty())
        throw SceneError(scene.sensor.where, fmt::format("{} cannot render what moves: what it computes in one pass would have to hold in later ones; "
                                                         "choose sppm (-m sppm), or give shutter_close the value of shutter_open",
                                                         which));
}

// The scene's values count for the scene's own method alone; the command line's always.
Parameters choose_parameters(const Scene& scene, const RenderSettings& settings, const MethodInfo& method)
{
    std::map<std::string, ParameterValue> values;
    const bool same_method = settings.method.empty() || settings.method == scene.integrator.method;
    for (const auto& [name, text] : scene.integrator.parameters) {
        const bool known = std::any_of(method.parameters.begin(), method.parameters.end(), [&](const ParameterSpec& spec) { return spec.name == name; });
        if (same_method || known) values[name] = {text.value, text.where};
    }
    for (const auto& [name, text] : settings.parameters) values[name] = {text, {}};
    Parameters parameters(method.name, method.parameters, values);
    check_motion(scene, method, parameters);
    return parameters;
}

// Throws UsageError unless errors are not asked for, or the method can estimate them.
std::optional<ErrorEstimate> make_error_estimate(Device& device, const Film& film, const MethodInfo& method, const Parameters& parameters,
                                                 const RenderSettings& settings)
{
    if (!settings.errors) return std::nullopt;
    if (method.error_model == ErrorModel::none) {
        std::vector<std::string> able;
        for (const MethodInfo* info : all_methods())
            if (info->error_model != ErrorModel::none) able.push_back(info->name);
        throw UsageError(fmt::format("{} cannot estimate its error; choose one of {} (-m NAME), or leave out --errors, --error-image and --target-error",
                                     method.name, fmt::join(able, ", ")));
    }
    for (const auto& [name, value] : method.errors_need)
        if (parameters.text(name) != value)
            throw UsageError(fmt::format(
                "{0} estimates its error with {1}={2}, not with {1}={3}: use -p {1}={2}, or leave out --errors, --error-image and "
                "--target-error",
                method.name, name, value, parameters.text(name)));
    const std::size_t pixels = static_cast<std::size_t>(film.crop_width) * static_cast<std::size_t>(film.crop_height);
    return ErrorEstimate(device, pixels, method.error_model == ErrorModel::bias_and_variance, settings.errors->confidence);
}

DeviceFilm make_film(Device& device, const Film& description, const MethodInfo& method, const Parameters& parameters,
                     const RenderSettings& settings)
{
    DeviceFilm film(device, description.crop_width, description.crop_height);
    film.errors = make_error_estimate(device, description, method, parameters, settings);
    return film;
}

// Throws SceneError when the film's accumulators alone cannot be allocated.
void check_film(const Film& film, const DeviceInfo& device)
{
    const auto pixels = static_cast<std::uint64_t>(film.crop_width) * static_cast<std::uint64_t>(film.crop_height);
    const std::uint64_t most = std::min(device.largest_buffer_bytes / sizeof(FilmPixel), device.memory_bytes / (sizeof(FilmPixel) + sizeof(FirstHitPixel)));
    if (pixels <= most) return;
    throw SceneError(film.where, fmt::format("a film of {}x{} pixels is too large for {}, which holds {} million; use a smaller film or crop (--size WxH)",
                                             film.crop_width, film.crop_height, device.name, most / 1000000));
}

// Another film size keeps the field of view; a crop scales with it.
Scene with_size(Scene scene, const RenderSettings& settings)
{
    if (!settings.size) return scene;
    auto& film = scene.film;
    const auto [width, height] = *settings.size;
    const double sx = static_cast<double>(width) / film.width, sy = static_cast<double>(height) / film.height;
    film.crop_x = static_cast<int>(film.crop_x * sx);
    film.crop_y = static_cast<int>(film.crop_y * sy);
    film.crop_width = std::clamp(static_cast<int>(film.crop_width * sx + 0.5), 1, width - film.crop_x);
    film.crop_height = std::clamp(static_cast<int>(film.crop_height * sy + 0.5), 1, height - film.crop_y);
    film.width = width;
    film.height = height;
    return scene;
}

Scene sized_scene(Scene scene, const RenderSettings& settings, const DeviceInfo& device)
{
    scene = with_size(std::move(scene), settings);
    check_film(scene.film, device);
    return scene;
}

} // namespace

struct RenderSession::State {
    State(Scene scene_in, Device& device_in, const RenderSettings& settings)
        : scene(sized_scene(std::move(scene_in), settings, device_in.info())), device(device_in), info(choose_method(scene, settings)),
          parameters(choose_parameters(scene, settings, info)), seed(settings.seed.value_or(scene.integrator.seed)),
          device_scene(device, scene, is_spectral(parameters), light_selection(parameters)), camera(make_camera(scene.sensor, scene.film)),
          filter(make_pixel_filter(scene.film.filter)), film(make_film(device, scene.film, info, parameters, settings)),
          motion(device_scene, scene, camera, seed),
          spectral(device, device_scene, seed), context{device, device_scene, camera, filter, film, spectral, seed, [this] { return light_fingerprint(flatten_scene(scene)); }},
          method(info.create(context, parameters))
    {
        warn_of_dispersion();
        warn_of_beams();
    }

    void warn_of_dispersion() const
    {
        if (!scene.has_dispersion() || device_scene.is_spectral()) return;
        const std::string cure = parameters.has("spectral") ? "with spectral=true (-p spectral=true)"
                                                            : fmt::format("in spectral transport, which {} does not have (as -m path -p spectral=true has)", info.name);
        log_warning(fmt::format("the scene's glass has dispersion, which shows only {}; each index is taken at 589.3 nm", cure));
    }

    void warn_of_beams() const
    {
        if (info.traces_light) return;
        for (const EmitterDescription& emitter : scene.emitters)
            if (std::holds_alternative<CollimatedEmitter>(emitter.model))
                log_warning(fmt::format("{}{} has no paths from lights, so this collimated emitter stays dark: choose sppm (-m sppm)",
                                        emitter.where.prefix(), info.name));
    }

    Scene scene;
    Device& device;
    const MethodInfo& info;
    Parameters parameters;
    std::uint64_t seed;
    DeviceScene device_scene;
    Camera camera;
    PixelFilter filter;
    DeviceFilm film;
    SceneMotion motion;
    SpectralTransport spectral;
    RenderContext context;
    std::unique_ptr<Method> method;
    std::uint64_t iterations = 0;
    bool is_whole = true; // of whole iterations
    double seconds = 0.0;
    RenderProgress resumed; // what had been done when this session took over
    std::optional<std::string> scene_fingerprint;

    RenderIdentity identity();
    RenderProgress progress();
    void serialize(StateArchive& archive)
    {
        film.serialize(archive);
        method->serialize(archive);
    }
};

RenderIdentity RenderSession::State::identity()
{
    // Of the camera where the shutter opens, wherever it is now.
    if (!scene_fingerprint) scene_fingerprint = fingerprint(flatten_scene(scene), make_camera(scene.sensor, scene.film), filter);
    auto values = parameters.all();
    std::erase_if(values, [](const auto& parameter) { return parameter.first == "iterations" || parameter.first == "save_map"; });
    return {SUNDOG_VERSION, info.name, std::move(values), seed, scene.film.crop_width, scene.film.crop_height, scene.file, *scene_fingerprint, film.errors.has_value()};
}

RenderProgress RenderSession::State::progress()
{
    RenderProgress progress{device.info().name, iterations, seconds, resumed.stage_seconds};
    for (const StageTime& stage : device.profile().stages()) {
        auto& sums = progress.stage_seconds;
        const auto known = std::find_if(sums.begin(), sums.end(), [&](const auto& sum) { return sum.first == stage.label; });
        if (known == sums.end()) sums.emplace_back(stage.label, stage.seconds);
        else known->second += stage.seconds;
    }
    return progress;
}

RenderSession::RenderSession(Scene scene, Device& device, const RenderSettings& settings) : state_(std::make_unique<State>(std::move(scene), device, settings)) {}

RenderSession::~RenderSession() = default;

std::uint64_t RenderSession::requested_iterations() const
{
    const std::int64_t asked = state_->parameters.integer("iterations");
    if (asked > 0) return static_cast<std::uint64_t>(asked);
    const int samples = state_->scene.integrator.sample_count;
    return samples > 0 ? static_cast<std::uint64_t>(samples) : default_iterations;
}

void RenderSession::iterate()
{
    const Timer timer;
    fault_point(FaultPoint::iterate);
    KeptValues before;
    state_->serialize(before);
    try {
        state_->motion.begin_pass(state_->iterations);
        state_->spectral.begin_pass(state_->iterations);
        state_->method->render_pass(state_->iterations);
        state_->device.finish();
    } catch (...) {
        // Totals as they were. What lies on the device was changed last of all, or is not whole.
        state_->is_whole = state_->film.is_whole() && state_->film.iterations() == state_->iterations;
        before.rewind();
        state_->serialize(before);
        throw;
    }
    state_->iterations++;
    state_->seconds += timer.seconds();
}

bool RenderSession::can_be_saved() const
{
    return state_->is_whole;
}

RelativeError RenderSession::relative_error() const
{
    return state_->film.relative_error();
}

const MethodInfo& RenderSession::method() const
{
    return state_->info;
}

std::uint64_t RenderSession::iterations_done() const
{
    return state_->iterations;
}

void RenderSession::save_checkpoint(const std::filesystem::path& file) const
{
    fault_point(FaultPoint::checkpoint);
    assert(state_->is_whole);
    CheckpointWriter writer(file);
    writer.text("render", checkpoint_text(state_->identity(), state_->progress()));
    state_->serialize(writer);
    writer.commit();
}

void RenderSession::resume(const std::filesystem::path& file)
{
    assert(state_->iterations == 0);
    CheckpointReader reader(file);
    state_->resumed = progress_of_same_render(reader.text("render", most_description_bytes), state_->identity(), file);
    try {
        state_->serialize(reader);
    } catch (const DeviceError& error) {
        reader.refuse(fmt::format("asks for more than this device can hold ({})", error.what()));
    } catch (const std::bad_alloc&) {
        reader.refuse("asks for more memory than there is");
    }
    reader.finish();
    reader.check(state_->film.iterations() == state_->resumed.iterations, "film iterations");
    state_->iterations = state_->resumed.iterations;
    state_->seconds = state_->resumed.seconds;
    const std::string& device = state_->device.info().name;
    if (state_->resumed.device != device)
        log_warning(fmt::format("{} was rendered on {}; going on with {} is as good, but not the same to the last bit", file.string(),
                                state_->resumed.device, device));
}

Image RenderSession::image() const
{
    fault_point(FaultPoint::image);
    Image image = state_->film.resolve();
    state_->method->resolve(image);
    const RenderStatistics s = statistics();
    std::vector<std::string> parameters;
    for (const auto& [name, value] : s.parameters) parameters.push_back(name + "=" + value);
    image.metadata = {{"sundog:version", SUNDOG_VERSION},
                      {"sundog:method", s.method},
                      {"sundog:parameters", fmt::format("{}", fmt::join(parameters, " "))},
                      {"sundog:scene", state_->identity().scene},
                      {"sundog:seed", std::to_string(s.seed)},
                      {"sundog:iterations", std::to_string(s.iterations)},
                      {"sundog:light_subpaths", std::to_string(s.counters.light_subpaths)},
                      {"sundog:camera_subpaths", std::to_string(s.counters.camera_subpaths)},
                      {"sundog:device", s.device},
                      {"sundog:seconds", fmt::format("{:.3f}", s.render_seconds)}};
    if (s.error) {
        image.metadata.emplace_back("sundog:error_confidence", fmt::format("{:g}", s.error_confidence));
        image.metadata.emplace_back("sundog:error_bound", fmt::format("{:.6g}", s.error->bound));
    }
    return image;
}

RenderStatistics RenderSession::statistics() const
{
    RenderStatistics statistics;
    statistics.method = state_->info.name;
    statistics.parameters = state_->parameters.all();
    statistics.seed = state_->seed;
    statistics.device = state_->device.info().name;
    statistics.iterations = state_->iterations;
    statistics.resumed_iterations = state_->resumed.iterations;
    statistics.counters = state_->method->counters();
    statistics.render_seconds = state_->seconds;
    statistics.stage_seconds = state_->progress().stage_seconds;
    statistics.kernel_build_seconds = state_->device.profile().build_seconds();
    statistics.peak_device_bytes = state_->device.peak_bytes();
    if (const auto& errors = state_->film.errors) {
        statistics.error = relative_error();
        statistics.error_confidence = errors->confidence();
    }
    statistics.invalid_samples = state_->film.invalid_samples();
    return statistics;
}

const Scene& RenderSession::scene() const
{
    return state_->scene;
}

int RenderSession::width() const
{
    return state_->scene.film.crop_width;
}

int RenderSession::height() const
{
    return state_->scene.film.crop_height;
}

} // namespace sundog
