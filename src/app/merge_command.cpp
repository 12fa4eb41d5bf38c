// sundog merge OUT PART...
#include "app/commands.h"
#include "app/option_values.h"
#include "base/log.h"
#include "film/image_codec.h"
#include "film/image_io.h"
#include "film/merge_images.h"

#include <fmt/format.h>

#include <memory>

namespace sundog {

namespace {

struct MergeOptions {
    std::string output;
    std::vector<std::string> parts;
    std::string exposure = "0";
};

ExitStatus merge(const MergeOptions& options)
{
    const auto exposure_stops = static_cast<float>(parse_finite("--exposure", options.exposure));
    check_writable(options.output);
    if (!can_encode(ImageFormat::exr))
        throw FileError("merge needs .exr parts, whose metadata say how they were rendered; this build of Sundog knows .pfm only, which holds none");
    ImageMerger merger;
    for (const std::string& part : options.parts) {
        merger.check(read_image_header(part), part);
        merger.add(read_image(part), part);
    }
    write_image(options.output, merger.result(), exposure_stops);
    log_info(fmt::format("merged {} {} into {} ({} iterations, seeds {})", options.parts.size(), options.parts.size() == 1 ? "part" : "parts", options.output,
                         merger.iterations(), merger.seeds()));
    return ExitStatus::done;
}

} // namespace

void add_merge_command(CLI::App& app, ExitStatus& status)
{
    auto options = std::make_shared<MergeOptions>();
    CLI::App* command = app.add_subcommand("merge", "Add up renders made apart, with different seeds");
    command->add_option("OUT", options->output, "Image to write, " + writable_endings() + "; may be one of the parts")->required();
    command->add_option("PART", options->parts, "EXR images by sundog render or merge: the same scene, size, method and parameters, each with another --seed")
        ->required()
        ->expected(1, -1);
    command->add_option("--exposure", options->exposure, "Scale PNG by 2^STOPS")->type_name("STOPS");
    command->footer("Every part counts by its iterations. For path and ptracer, and whatever else is unbiased, OUT is as good as one render of all\n"
                    "iterations. Photon maps blur: sppm and pppm shrink their radii from one iteration to the next, and in OUT, the mean of\n"
                    "independent renders, the noise is that of all iterations together but the blur that of the parts. There few long parts are\n"
                    "better than many short ones. variance.* of OUT is that of one iteration, from all of them (for sppm, whose pixels are no\n"
                    "plain means, an estimate of it).");
    command->callback([options, &status] { status = merge(*options); });
}

} // namespace sundog
