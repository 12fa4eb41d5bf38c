#include "render/checkpoint.h"

#include "base/errors.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace sundog {

namespace {

nlohmann::ordered_json json_of(const RenderIdentity& identity)
{
    nlohmann::ordered_json json;
    json["version"] = identity.version;
    json["method"] = identity.method;
    json["parameters"] = identity.parameters;
    json["seed"] = identity.seed;
    json["width"] = identity.width;
    json["height"] = identity.height;
    json["scene_file"] = identity.scene_file;
    json["scene"] = identity.scene;
    json["errors"] = identity.errors;
    return json;
}

RenderIdentity identity_of(const nlohmann::ordered_json& json)
{
    RenderIdentity identity;
    json.at("version").get_to(identity.version);
    json.at("method").get_to(identity.method);
    json.at("parameters").get_to(identity.parameters);
    json.at("seed").get_to(identity.seed);
    json.at("width").get_to(identity.width);
    json.at("height").get_to(identity.height);
    json.at("scene_file").get_to(identity.scene_file);
    json.at("scene").get_to(identity.scene);
    identity.errors = json.value("errors", false); // which older checkpoints do not say
    return identity;
}

// Renders of more iterations end in no lifetime, and products of a count with another stay within 64 bits.
constexpr std::uint64_t most_iterations = std::uint64_t(1) << 32;

[[noreturn]] void refuse_number(const std::filesystem::path& file, const std::string& number)
{
    throw FileError(fmt::format("{}: cannot resume, the checkpoint is damaged: no render has {}; render afresh without --resume", file.string(), number));
}

// A library would read -3 as 2^64 - 3.
std::uint64_t count_of(const nlohmann::ordered_json& json, const std::filesystem::path& file)
{
    if (!json.is_number_unsigned() || json == 0u || json > most_iterations) refuse_number(file, json.dump() + " iterations");
    return json.get<std::uint64_t>();
}

double seconds_of(const nlohmann::ordered_json& json, const std::filesystem::path& file)
{
    constexpr double most_seconds = 1e12;
    if (!json.is_number() || !(json.get<double>() >= 0.0 && json.get<double>() <= most_seconds)) refuse_number(file, json.dump() + " seconds");
    return json.get<double>();
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& difference, const std::string& cure)
{
    throw FileError(fmt::format("{}: cannot resume, the checkpoint is of {}; {}", file.string(), difference, cure));
}

// What a size or a seed would change in the fingerprint too is compared first, so that the message names the cause.
void check_same(const RenderIdentity& stored, const RenderIdentity& wanted, const std::filesystem::path& file)
{
    const std::string other = "or choose another --checkpoint file";
    if (stored.version != wanted.version)
        refuse(file, fmt::format("sundog {}, this is {}", stored.version, wanted.version), "resume with the version that wrote it, " + other);
    if (stored.method != wanted.method)
        refuse(file, fmt::format("method {}, not {}", stored.method, wanted.method), fmt::format("use -m {}, {}", stored.method, other));
    if (stored.parameters.size() != wanted.parameters.size()) refuse(file, "a method with other parameters", other.substr(3));
    for (std::size_t i = 0; i < wanted.parameters.size(); i++) {
        const auto& [name, value] = stored.parameters[i];
        if (stored.parameters[i] != wanted.parameters[i])
            refuse(file, fmt::format("{}={}, not {}={}", name, value, wanted.parameters[i].first, wanted.parameters[i].second),
                   fmt::format("use -p {}={}, {}", name, value, other));
    }
    if (stored.seed != wanted.seed) refuse(file, fmt::format("seed {}, not {}", stored.seed, wanted.seed), fmt::format("use -s {}, {}", stored.seed, other));
    if (stored.width != wanted.width || stored.height != wanted.height)
        refuse(file, fmt::format("{}x{} pixels, not {}x{}", stored.width, stored.height, wanted.width, wanted.height), "use that size, " + other);
    if (stored.errors != wanted.errors)
        refuse(file, fmt::format("a render that {}", stored.errors ? "estimates its error" : "does not estimate its error"),
               (stored.errors ? "use --errors, " : "leave out --errors, --error-image and --target-error, ") + other);
    if (stored.scene != wanted.scene)
        refuse(file, fmt::format("another scene ({}, not {} as it is now)", stored.scene_file, wanted.scene_file), "render that scene, " + other);
}

} // namespace

std::string checkpoint_text(const RenderIdentity& identity, const RenderProgress& progress)
{
    nlohmann::ordered_json json = json_of(identity);
    json["device"] = progress.device;
    json["iterations"] = progress.iterations;
    json["seconds"] = progress.seconds;
    json["stage_seconds"] = progress.stage_seconds;
    // A file name need not be UTF-8.
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

RenderProgress progress_of_same_render(const std::string& text, const RenderIdentity& wanted, const std::filesystem::path& file)
{
    try {
        const auto json = nlohmann::ordered_json::parse(text);
        check_same(identity_of(json), wanted, file);
        RenderProgress progress;
        json.at("device").get_to(progress.device);
        progress.iterations = count_of(json.at("iterations"), file);
        progress.seconds = seconds_of(json.at("seconds"), file);
        for (const auto& stage : json.at("stage_seconds")) progress.stage_seconds.emplace_back(stage.at(0), seconds_of(stage.at(1), file));
        return progress;
    } catch (const nlohmann::json::exception& error) {
        throw FileError(fmt::format("{}: cannot resume, the checkpoint does not describe its render ({}); render afresh without --resume", file.string(),
                                    error.what()));
    }
}

} // namespace sundog
