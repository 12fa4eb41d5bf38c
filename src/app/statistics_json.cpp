#include "app/statistics_json.h"

#include "methods/method.h"
#include "methods/parameters.h"

#include <algorithm>

namespace sundog {

namespace {

nlohmann::ordered_json parameter_json(const MethodInfo* method, const std::string& name, const std::string& text)
{
    if (!method) return text;
    const auto spec = std::find_if(method->parameters.begin(), method->parameters.end(), [&](const ParameterSpec& s) { return s.name == name; });
    if (spec == method->parameters.end() || spec->type == ParameterType::choice) return text;
    // Canonical numbers and booleans are JSON as they stand.
    auto value = nlohmann::ordered_json::parse(text, nullptr, false);
    return value.is_discarded() ? nlohmann::ordered_json(text) : value;
}

nlohmann::ordered_json error_json(const RelativeError& error, double confidence, const std::optional<ErrorTarget>& target)
{
    nlohmann::ordered_json json{{"confidence", confidence}, {"bound", error.bound}, {"expected", error.expected()}, {"bias", error.bias}, {"noise", error.noise}};
    if (target) {
        json["target"] = target->error;
        json["target_met"] = target->met;
    }
    return json;
}

} // namespace

nlohmann::ordered_json statistics_json(const RenderStatistics& statistics, double wall_seconds, const std::optional<ErrorTarget>& target)
{
    nlohmann::ordered_json json;
    json["version"] = SUNDOG_VERSION;
    json["method"] = statistics.method;
    json["parameters"] = nlohmann::ordered_json::object();
    for (const auto& [name, text] : statistics.parameters) json["parameters"][name] = parameter_json(find_method(statistics.method), name, text);
    json["seed"] = statistics.seed;
    json["device"] = statistics.device;
    json["iterations"] = statistics.iterations;
    json["resumed_iterations"] = statistics.resumed_iterations;
    json["light_subpaths"] = statistics.counters.light_subpaths;
    json["camera_subpaths"] = statistics.counters.camera_subpaths;
    json["photons_stored"] = statistics.counters.photons_stored;
    json["rays"] = statistics.counters.rays;
    if (statistics.counters.mutations > 0) {
        json["mutations"] = statistics.counters.mutations;
        json["mutations_accepted"] = statistics.counters.mutations_accepted;
    }
    // Null: not known.
    json["seconds"] = statistics.stage_seconds.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json::object();
    for (const auto& [stage, seconds] : statistics.stage_seconds) json["seconds"][stage] = seconds;
    json["render_seconds"] = statistics.render_seconds;
    json["wall_seconds"] = wall_seconds;
    json["kernel_build_seconds"] = statistics.kernel_build_seconds;
    json["peak_device_bytes"] = statistics.peak_device_bytes;
    if (statistics.error) json["error"] = error_json(*statistics.error, statistics.error_confidence, target);
    json["invalid_samples"] = statistics.invalid_samples;
    return json;
}

} // namespace sundog
