// sundog info SCENE.xml
#include "app/commands.h"
#include "app/option_values.h"
#include "app/scene_summary.h"
#include "base/log.h"
#include "import/mitsuba_xml.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <iostream>
#include <memory>

namespace sundog {

namespace {

struct InfoOptions {
    std::string scene;
    std::vector<std::string> defines;
    bool json = false;
};

std::string counts_text(const std::map<std::string, std::size_t>& counts)
{
    std::string text;
    for (const auto& [kind, number] : counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", number, kind);
    return text.empty() ? "none" : text;
}

std::string point_text(Vec3 p) { return fmt::format("({:g}, {:g}, {:g})", p.x, p.y, p.z); }

std::string size_text(std::uint64_t bytes)
{
    const double kilobytes = static_cast<double>(bytes) * 1e-3;
    return kilobytes < 1000 ? fmt::format("{:.1f} kB", kilobytes) : fmt::format("{:.1f} MB", kilobytes * 1e-3);
}

std::string integrator_text(const SceneSummary& summary)
{
    if (summary.method.empty()) return "none; --method chooses, default sppm";
    std::string text = summary.method;
    for (const auto& [name, value] : summary.parameters) text += " " + name + "=" + value;
    return text;
}

void print_text(const SceneSummary& summary, std::size_t warnings)
{
    const auto line = [](const char* name, const std::string& value) { std::cout << fmt::format("{:<12}{}\n", name, value); };
    line("scene", summary.file);
    line("shapes", counts_text(summary.shapes) + fmt::format("; {} triangles", summary.triangles));
    if (summary.instances > 0)
        line("instances", fmt::format("{} of {} groups; {} triangles with their copies", summary.instances, summary.groups, summary.triangles_with_copies));
    line("bsdfs", counts_text(summary.bsdfs));
    line("emitters", counts_text(summary.emitters) + fmt::format("; {} lights to sample", summary.lights));
    line("bounds", summary.bounds.empty() ? "empty" : point_text(summary.bounds.lower) + " to " + point_text(summary.bounds.upper));
    line("image", fmt::format("{}x{} pixels, {} filter", summary.width, summary.height, summary.filter));
    line("integrator", integrator_text(summary));
    line("memory", fmt::format("{} scene, {} film; the method's buffers come on top", size_text(summary.scene_bytes), size_text(summary.film_bytes)));
    line("warnings", std::to_string(warnings));
}

nlohmann::ordered_json point_json(Vec3 p) { return {p.x, p.y, p.z}; }

void print_json(const SceneSummary& summary, const std::vector<std::string>& warnings)
{
    nlohmann::ordered_json json;
    json["scene"] = summary.file;
    json["shapes"] = summary.shapes;
    json["triangles"] = summary.triangles;
    json["groups"] = summary.groups;
    json["instances"] = summary.instances;
    json["triangles_with_copies"] = summary.triangles_with_copies;
    json["bsdfs"] = summary.bsdfs;
    json["emitters"] = summary.emitters;
    json["lights"] = summary.lights;
    json["bounds"] = summary.bounds.empty() ? nlohmann::ordered_json(nullptr)
                                            : nlohmann::ordered_json{{"lower", point_json(summary.bounds.lower)}, {"upper", point_json(summary.bounds.upper)}};
    json["width"] = summary.width;
    json["height"] = summary.height;
    json["filter"] = summary.filter;
    json["integrator"] = {{"method", summary.method}, {"parameters", summary.parameters}};
    json["scene_bytes"] = summary.scene_bytes;
    json["film_bytes"] = summary.film_bytes;
    json["warnings"] = warnings;
    std::cout << json.dump(2) << "\n";
}

ExitStatus info(const InfoOptions& options)
{
    LoadOptions load;
    load.defines = parse_assignments("-D", options.defines);
    const LoadedScene loaded = load_scene(options.scene, load);
    for (const std::string& warning : loaded.warnings) log_warning(warning);
    const SceneSummary summary = summarize(loaded.scene);
    if (options.json) print_json(summary, loaded.warnings);
    else print_text(summary, loaded.warnings.size());
    return ExitStatus::done;
}

} // namespace

void add_info_command(CLI::App& app, ExitStatus& status)
{
    auto options = std::make_shared<InfoOptions>();
    CLI::App* command = app.add_subcommand("info", "Load and check a scene; print counts, bounds and memory, and what cannot be rendered");
    command->add_option("SCENE", options->scene, "Mitsuba scene file")->required();
    command->add_option("-D", options->defines, "Scene parameter, $NAME in the file (repeatable)")->type_name("NAME=VALUE")->allow_extra_args(false);
    command->add_flag("--json", options->json, "Print JSON");
    command->callback([options, &status] { status = info(*options); });
}

} // namespace sundog
