#include "film/merge_images.h"

#include "base/errors.h"
#include "film/error_estimate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <sstream>

namespace sundog {

namespace {

const std::string* find_metadata(const Image& image, const std::string& name)
{
    for (const auto& [key, value] : image.metadata)
        if (key == "sundog:" + name) return &value;
    return nullptr;
}

const std::string& metadata(const Image& image, const std::string& name, const std::filesystem::path& file)
{
    if (const std::string* value = find_metadata(image, name)) return *value;
    throw FileError(
        fmt::format("{}: cannot be merged, it has no metadata sundog:{}; parts are .exr files as sundog render writes them", file.string(), name));
}

template <class Number> Number number(const Image& image, const std::string& name, const std::filesystem::path& file)
{
    const std::string& text = metadata(image, name, file);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        throw FileError(fmt::format("{}: cannot be merged, its metadata sundog:{} is no number: \"{}\"", file.string(), name, text));
    return value;
}

// In place of the index of a bias channel.
constexpr int no_error = -2, no_bias = -1;

std::string optional_metadata(const Image& image, const std::string& name)
{
    const std::string* value = find_metadata(image, name);
    return value ? *value : "none";
}

std::vector<std::string> words(const std::string& text)
{
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
}

// But not the number of iterations, which is a goal.
std::string parameters_of(const Image& image, const std::filesystem::path& file)
{
    std::vector<std::string> assignments = words(metadata(image, "parameters", file));
    std::erase_if(assignments, [](const std::string& assignment) { return assignment.starts_with("iterations="); });
    return fmt::format("{}", fmt::join(assignments, " "));
}

} // namespace

void ImageMerger::check(const Image& header, const std::filesystem::path& file) const
{
    if (number<std::uint64_t>(header, "iterations", file) == 0) throw FileError(file.string() + ": cannot be merged, it has no iterations");
    if (!first_.channels.empty()) check_like_first(header, file);
}

void ImageMerger::add(const Image& part, const std::filesystem::path& file)
{
    check(part, file);
    const auto iterations = number<std::uint64_t>(part, "iterations", file);
    if (first_.channels.empty()) {
        start(part, file);
        check_like_first(part, file);
    }
    add_seeds(part, file);
    add_pixels(part, static_cast<double>(iterations), file);
    add_totals(part, file);
    iterations_ += iterations;
}

void ImageMerger::start(const Image& part, const std::filesystem::path& file)
{
    first_.width = part.width;
    first_.height = part.height;
    first_.channels = part.channels;
    first_.metadata = part.metadata;
    first_file_ = file;
    means_.assign(part.pixels.size(), 0.0);
    squares_.assign(part.pixels.size(), 0.0);
    is_variance_.assign(part.channels.size(), false);
    half_widths_.assign(part.pixels.size(), 0.0);
    for (const std::string& channel : part.channels) {
        const auto bias = channel.starts_with("error.") ? std::find(part.channels.begin(), part.channels.end(), "bias." + channel.substr(6)) : part.channels.end();
        bias_of_error_.push_back(!channel.starts_with("error.")  ? no_error
                                 : bias == part.channels.end() ? no_bias
                                                               : static_cast<int>(bias - part.channels.begin()));
        const auto found = std::find(part.channels.begin(), part.channels.end(), "variance." + channel);
        const auto index = found - part.channels.begin();
        variance_of_.push_back(found == part.channels.end() ? -1 : static_cast<int>(index));
        if (found != part.channels.end()) is_variance_[static_cast<std::size_t>(index)] = true;
    }
}

void ImageMerger::check_like_first(const Image& part, const std::filesystem::path& file) const
{
    const auto same = [&](const std::string& what, const std::string& here, const std::string& there) {
        if (here == there) return;
        throw FileError(fmt::format("{}: cannot be merged, its {} is {} but that of {} is {}", file.string(), what, here, first_file_.string(), there));
    };
    same("size", fmt::format("{}x{}", part.width, part.height), fmt::format("{}x{}", first_.width, first_.height));
    same("list of channels", fmt::format("{}", fmt::join(part.channels, " ")), fmt::format("{}", fmt::join(first_.channels, " ")));
    same("method", metadata(part, "method", file), metadata(first_, "method", first_file_));
    same("list of parameters", parameters_of(part, file), parameters_of(first_, first_file_));
    same("error confidence", optional_metadata(part, "error_confidence"), optional_metadata(first_, "error_confidence"));
    if (metadata(part, "scene", file) != metadata(first_, "scene", first_file_))
        throw FileError(fmt::format("{}: cannot be merged, it shows another scene, or another camera or filter, than {}", file.string(), first_file_.string()));
}

void ImageMerger::add_seeds(const Image& part, const std::filesystem::path& file)
{
    for (const std::string& seed : words(metadata(part, "seed", file))) {
        const auto [other, is_new] = file_of_seed_.emplace(seed, file);
        if (!is_new)
            throw FileError(fmt::format("{}: cannot be merged, it was rendered with seed {}, as {} was: the same random numbers bring nothing new; "
                                        "render it with another --seed",
                                        file.string(), seed, other->second.string()));
        seeds_ += (seeds_.empty() ? "" : " ") + seed;
    }
}

void ImageMerger::add_totals(const Image& part, const std::filesystem::path& file)
{
    light_subpaths_ += number<std::uint64_t>(part, "light_subpaths", file);
    camera_subpaths_ += number<std::uint64_t>(part, "camera_subpaths", file);
    seconds_ += number<double>(part, "seconds", file);
    const std::string& device = metadata(part, "device", file);
    if (std::find(devices_.begin(), devices_.end(), device) == devices_.end()) devices_.push_back(device);
}

// Of the interval that a bound was made from: bound - |bias|.
double ImageMerger::half_width(const Image& part, std::size_t error, std::size_t channel) const
{
    const int bias = bias_of_error_[channel];
    return part.pixels[error] - (bias == no_bias ? 0.0 : std::abs(static_cast<double>(part.pixels[error - channel + static_cast<std::size_t>(bias)])));
}

// Means and sums of squares of two sets of samples make those of their union [Chan, Golub and LeVeque 1979,
// "Updating formulae and a pairwise algorithm for computing sample variances"].
void ImageMerger::add_pixels(const Image& part, double iterations, const std::filesystem::path& file)
{
    const double before = static_cast<double>(iterations_), total = before + iterations;
    const std::size_t channels = part.channels.size();
    for (std::size_t i = 0; i < part.pixels.size(); i++) {
        const std::size_t channel = i % channels;
        if (!std::isfinite(part.pixels[i])) {
            const std::size_t pixel = i / channels, width = static_cast<std::size_t>(part.width);
            throw FileError(fmt::format("{}: cannot be merged, {} of pixel ({}, {}) is {}", file.string(), part.channels[channel], pixel % width,
                                        pixel / width, part.pixels[i]));
        }
        if (is_variance_[channel]) continue;
        if (bias_of_error_[channel] != no_error) {
            half_widths_[i] += std::pow(iterations * half_width(part, i, channel), 2);
            continue;
        }
        const double difference = part.pixels[i] - means_[i];
        means_[i] += difference * (iterations / total);
        if (variance_of_[channel] < 0) continue;
        const double variance = part.pixels[i - channel + static_cast<std::size_t>(variance_of_[channel])]; // of one iteration, unbiased
        squares_[i] += (iterations - 1.0) * variance + difference * difference * (before * iterations / total);
    }
}

Image ImageMerger::result() const
{
    Image image(first_.width, first_.height, first_.channels);
    const std::size_t channels = first_.channels.size();
    const double degrees = static_cast<double>(iterations_) - 1.0;
    for (std::size_t i = 0; i < means_.size(); i++) {
        const std::size_t channel = i % channels;
        if (is_variance_[channel]) continue;
        if (const int bias = bias_of_error_[channel]; bias != no_error) {
            const double mean_bias = bias == no_bias ? 0.0 : std::abs(means_[i - channel + static_cast<std::size_t>(bias)]);
            image.pixels[i] = static_cast<float>(mean_bias + std::sqrt(half_widths_[i]) / static_cast<double>(iterations_));
            continue;
        }
        image.pixels[i] = static_cast<float>(means_[i]);
        if (variance_of_[channel] >= 0)
            image.pixels[i - channel + static_cast<std::size_t>(variance_of_[channel])] = static_cast<float>(degrees > 0.0 ? squares_[i] / degrees : 0.0);
    }
    std::map<std::string, std::string> merged{{"sundog:version", SUNDOG_VERSION},
                                                    {"sundog:seed", seeds_},
                                                    {"sundog:iterations", std::to_string(iterations_)},
                                                    {"sundog:light_subpaths", std::to_string(light_subpaths_)},
                                                    {"sundog:camera_subpaths", std::to_string(camera_subpaths_)},
                                                    {"sundog:device", fmt::format("{}", fmt::join(devices_, ", "))},
                                                    {"sundog:seconds", fmt::format("{:.3f}", seconds_)}};
    if (find_metadata(first_, "error_bound")) merged["sundog:error_bound"] = fmt::format("{:.6g}", relative_bound(image));
    for (const auto& [name, value] : first_.metadata) image.metadata.emplace_back(name, merged.contains(name) ? merged.at(name) : value);
    return image;
}

} // namespace sundog
