// sundog info SCENE.xml [--dump FILE.xml]
#include "app/commands.h"
#include "app/output_conflicts.h"
#include "app/option_values.h"
#include "app/scene_summary.h"
#include "base/atomic_file.h"
#include "base/log.h"
#include "base/timer.h"
#include "import/mitsuba_xml.h"
#include "import/scene_writer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <iostream>
#include <memory>

#include <sys/resource.h>

namespace sundog {

namespace {

struct InfoOptions {
    std::string scene;
    std::vector<std::string> defines;
    bool json = false;
    std::string dump; // "-": standard output
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

// Empty where nothing moves.
std::string motion_text(const SceneSummary& summary)
{
    if (!summary.camera_moves && summary.moving_instances == 0) return "";
    std::string text = summary.camera_moves ? "camera" : "";
    if (summary.moving_instances > 0)
        text += fmt::format("{}{} of {} instances", text.empty() ? "" : ", ", summary.moving_instances, summary.instances);
    return text + fmt::format("; shutter {:g} to {:g}", summary.shutter.open, summary.shutter.close);
}

// What the importer did with the file beyond reading it.
struct LoadReport {
    std::vector<Warning> warnings;
    double seconds = 0.0; // of loading, building the acceleration structure and all checks
    std::uint64_t host_bytes = 0; // most that the process ever held
};

std::uint64_t peak_host_bytes()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::vector<std::string> texts_of(const std::vector<Warning>& warnings, WarningKind kind)
{
    std::vector<std::string> texts;
    for (const Warning& warning : warnings)
        if (warning.kind == kind) texts.push_back(warning.text);
    return texts;
}

constexpr std::pair<WarningKind, const char*> warning_groups[] = {
    {WarningKind::ignored, "ignored"}, {WarningKind::approximated, "approximated"}, {WarningKind::note, "notes"}};

void print_text(const SceneSummary& summary, const LoadReport& report)
{
    const auto line = [](const char* name, const std::string& value) { std::cout << fmt::format("{:<14}{}\n", name, value); };
    line("scene", summary.file);
    line("shapes", counts_text(summary.shapes) + fmt::format("; {} triangles", summary.triangles));
    if (summary.instances > 0)
        line("instances", fmt::format("{} of {} groups; {} triangles with their copies", summary.instances, summary.groups, summary.triangles_with_copies));
    if (const std::string motion = motion_text(summary); !motion.empty()) line("motion", motion);
    line("bsdfs", counts_text(summary.bsdfs));
    line("emitters", counts_text(summary.emitters) + fmt::format("; {} lights to sample", summary.lights));
    line("bounds", summary.bounds.empty() ? "empty" : point_text(summary.bounds.lower) + " to " + point_text(summary.bounds.upper));
    line("image", fmt::format("{}x{} pixels, {} filter", summary.width, summary.height, summary.filter));
    line("integrator", integrator_text(summary));
    line("device memory", fmt::format("{} scene, {} film; the method's buffers come on top", size_text(summary.scene_bytes), size_text(summary.film_bytes)));
    line("host memory", fmt::format("{} at most while loading", size_text(report.host_bytes)));
    line("loaded in", fmt::format("{:.2f} s", report.seconds));
    for (const auto& [kind, name] : warning_groups) {
        const auto texts = texts_of(report.warnings, kind);
        line(name, std::to_string(texts.size()));
        for (const std::string& text : texts) std::cout << "  " << text << "\n";
    }
}

nlohmann::ordered_json point_json(Vec3 p) { return {p.x, p.y, p.z}; }

void print_json(const SceneSummary& summary, const LoadReport& report)
{
    nlohmann::ordered_json json;
    json["scene"] = summary.file;
    json["shapes"] = summary.shapes;
    json["triangles"] = summary.triangles;
    json["groups"] = summary.groups;
    json["instances"] = summary.instances;
    json["triangles_with_copies"] = summary.triangles_with_copies;
    json["shutter"] = {{"open", summary.shutter.open}, {"close", summary.shutter.close}};
    json["moving"] = {{"camera", summary.camera_moves}, {"instances", summary.moving_instances}};
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
    json["host_bytes"] = report.host_bytes;
    json["load_seconds"] = report.seconds;
    json["warnings"] = std::vector<std::string>(report.warnings.begin(), report.warnings.end());
    for (const auto& [kind, name] : warning_groups) json[name] = texts_of(report.warnings, kind);
    std::cout << json.dump(2) << "\n";
}

void check_dump(const InfoOptions& options)
{
    if (options.dump.empty()) return;
    if (options.dump == "-") {
        if (options.json) throw UsageError("--json and --dump - both want standard output: dump to a file");
        return;
    }
    check_outputs_apart({{"the scene itself", options.scene}}, {{"--dump", options.dump}});
    check_file_writable(options.dump);
}

// The files of a dump are in a folder beside it: of a.xml in a-files, of standard output in SCENE-files here.
void dump(const Scene& scene, const std::string& target)
{
    const bool to_stdout = target == "-";
    const std::filesystem::path file = to_stdout ? std::filesystem::path(scene.file).filename() : std::filesystem::path(target);
    const std::string xml = write_scene(scene, file.parent_path() / (file.stem().string() + "-files"));
    if (to_stdout) std::cout << xml;
    else write_file(file, xml);
}

ExitStatus info(const InfoOptions& options)
{
    const Timer timer;
    LoadOptions load;
    load.defines = parse_assignments("-D", options.defines);
    check_dump(options);
    const LoadedScene loaded = load_scene(options.scene, load);
    const SceneSummary summary = summarize(loaded.scene);
    const LoadReport report{loaded.warnings, timer.seconds(), peak_host_bytes()};
    if (!options.dump.empty()) dump(loaded.scene, options.dump);
    if (options.dump == "-") return ExitStatus::done;
    if (options.json) print_json(summary, report);
    else print_text(summary, report);
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
    command->add_option("--dump", options->dump, "Write the scene with all defaults, parameters, includes and transforms resolved; meshes and images go beside it")
        ->type_name("FILE");
    command->footer("--dump FILE.xml writes Mitsuba 3 XML that renders to the same image, bit for bit, and the folder FILE-files that it needs;\n"
                    "the two can be moved together. --dump - prints the XML instead of the counts, its files in SCENE-files in this folder.");
    command->callback([options, &status] { status = info(*options); });
}

} // namespace sundog
