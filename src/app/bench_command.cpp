// sundog bench
#include "app/commands.h"
#include "base/atomic_file.h"
#include "base/log.h"
#include "render/bench.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <memory>

namespace sundog {

namespace {

struct BenchOptions {
    std::vector<std::string> sections;
    std::string device;
    std::vector<std::string> json; // given without a value: [""]
    bool wants_json = false;
};

std::vector<BenchSection> chosen_sections(const std::vector<std::string>& names)
{
    if (names.empty()) return bench_sections();
    std::vector<BenchSection> chosen;
    for (const std::string& name : names) {
        const auto& all = bench_sections();
        const auto found = std::find_if(all.begin(), all.end(), [&](const BenchSection& section) { return section.name == name; });
        if (found == all.end()) {
            std::string known;
            for (const BenchSection& section : all) known += (known.empty() ? "" : ", ") + section.name;
            throw UsageError("unknown bench section \"" + name + "\"; there are " + known);
        }
        chosen.push_back(*found);
    }
    return chosen;
}

void print_table(const std::vector<BenchFigure>& figures)
{
    std::size_t width = 0;
    for (const BenchFigure& figure : figures) width = std::max(width, figure.section.size() + figure.name.size() + 2);
    for (const BenchFigure& figure : figures) {
        const std::string name = figure.section + ": " + figure.name;
        std::string target;
        if (figure.target) target = fmt::format("  (target {} {:g}: {})", figure.at_most ? "at most" : "at least", *figure.target, figure.met() ? "met" : "missed");
        std::cout << fmt::format("{:<{}}  {:>10.4g} {}{}\n", name, width, figure.value, figure.unit, target);
    }
}

nlohmann::ordered_json to_json(const std::vector<BenchFigure>& figures, const DeviceInfo& device)
{
    nlohmann::ordered_json json;
    json["version"] = SUNDOG_VERSION;
    json["device"] = device.name;
    json["figures"] = nlohmann::ordered_json::array();
    for (const BenchFigure& figure : figures) {
        nlohmann::ordered_json entry{{"section", figure.section}, {"name", figure.name}, {"value", figure.value}, {"unit", figure.unit}};
        entry["target"] = figure.target ? nlohmann::ordered_json(*figure.target) : nlohmann::ordered_json(nullptr);
        if (figure.target) entry["met"] = figure.met();
        json["figures"].push_back(entry);
    }
    return json;
}

ExitStatus bench(const BenchOptions& options)
{
    const std::string file = options.json.empty() ? "" : options.json.front();
    if (!file.empty()) check_file_writable(file);
    const auto sections = chosen_sections(options.sections);
    Device device(select_device(options.device));
    std::vector<BenchFigure> figures;
    for (const BenchSection& section : sections) {
        log_info("measuring " + section.name + ": " + section.description);
        for (BenchFigure& figure : section.run(device)) figures.push_back(std::move(figure));
    }
    const std::string json = to_json(figures, device.info()).dump(2) + "\n";
    if (options.wants_json && file.empty()) std::cout << json;
    else print_table(figures);
    if (!file.empty()) write_file(file, json);
    return ExitStatus::done;
}

} // namespace

void add_bench_command(CLI::App& app, ExitStatus& status)
{
    auto options = std::make_shared<BenchOptions>();
    CLI::App* command = app.add_subcommand("bench", "Measure rates on a device");
    command->add_option("--section", options->sections, "Measure this section only (repeatable)")->type_name("NAME")->allow_extra_args(false);
    command->add_option("-d,--device", options->device, "OpenCL device: index, part of the name, cpu, gpu or all")->type_name("SELECTOR");
    CLI::Option* json = command->add_option("--json", options->json, "Write JSON to FILE, or to standard output without one")->type_name("FILE")->expected(0, 1);
    std::string sections = "Sections:\n";
    for (const BenchSection& section : bench_sections()) sections += "  " + section.name + ": " + section.description + "\n";
    command->footer(sections);
    command->callback([options, json, &status] {
        options->wants_json = json->count() > 0;
        status = bench(*options);
    });
}

} // namespace sundog
