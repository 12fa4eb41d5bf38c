// sundog compare IMAGE REFERENCE
#include "app/commands.h"
#include "app/option_values.h"
#include "base/log.h"
#include "film/compare.h"
#include "film/image_io.h"

#include <fmt/format.h>

#include <iostream>
#include <memory>

namespace sundog {

namespace {

struct CompareOptions {
    std::string image;
    std::string reference;
    std::vector<std::string> limits; // METRIC=V
};

std::vector<std::pair<std::string, double>> parse_limits(const std::vector<std::string>& texts)
{
    std::vector<std::pair<std::string, double>> limits;
    for (const auto& [metric, text] : parse_assignments("--max", texts)) {
        if (!ImageDifference{}.find(metric)) throw UsageError("--max knows no metric \"" + metric + "\"; use mse, rmse, relmse, mae or mean_ratio");
        limits.emplace_back(metric, parse_finite("--max " + metric, text));
    }
    return limits;
}

ExitStatus compare(const CompareOptions& options)
{
    const auto limits = parse_limits(options.limits);
    const ImageDifference difference = compare_files(options.image, options.reference);
    for (const auto& [name, value] : difference.all()) std::cout << fmt::format("{}: {:.9g}\n", name, value);

    ExitStatus status = ExitStatus::done;
    for (const auto& [metric, limit] : limits) {
        const double value = difference.find(metric).value();
        if (value <= limit) continue;
        log_error(fmt::format("{} is {:.6g}, above the {:.6g} that --max allows", metric, value, limit));
        status = ExitStatus::internal_error; // 1, the contract's status for images that differ
    }
    return status;
}

} // namespace

void add_compare_command(CLI::App& app, ExitStatus& status)
{
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command = app.add_subcommand("compare", "Print how far an image is from a reference");
    command->add_option("IMAGE", options->image, "Image file; PNG and other 8-bit files are taken as sRGB and made linear")->required();
    command->add_option("REFERENCE", options->reference, "Reference image of the same size")->required();
    command->add_option("--max", options->limits, "Exit with 1 when the metric is above this value (repeatable)")->type_name("METRIC=V")->allow_extra_args(false);
    command->footer("Metrics over R, G, B of all pixels, a of IMAGE and b of REFERENCE:\n"
                    "  mse         mean of (a-b)^2\n"
                    "  rmse        square root of mse\n"
                    "  relmse      mean of (a-b)^2 / (b^2 + 0.01)\n"
                    "  mae         mean of |a-b|\n"
                    "  mean_ratio  mean of a / mean of b (--max bounds it from above only)");
    command->callback([options, &status] { status = compare(*options); });
}

} // namespace sundog
