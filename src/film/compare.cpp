#include "film/compare.h"

#include "base/errors.h"
#include "film/image_codec.h"

#include <fmt/format.h>

#include <cmath>

namespace sundog {

namespace {

constexpr double relmse_floor = 0.01; // the contract's; keeps black pixels finite

[[noreturn]] void refuse_pixel(const std::filesystem::path& file, int x, int y, float value)
{
    throw FileError(fmt::format("{}: pixel ({}, {}) is {}; only finite images can be compared", file.string(), x, y, value));
}

} // namespace

std::array<std::pair<const char*, double>, 5> ImageDifference::all() const
{
    return {{{"mse", mse}, {"rmse", rmse}, {"relmse", relmse}, {"mae", mae}, {"mean_ratio", mean_ratio}}};
}

std::optional<double> ImageDifference::find(const std::string& metric) const
{
    for (const auto& [name, value] : all())
        if (metric == name) return value;
    return std::nullopt;
}

ImageDifference compare_images(const Image& image, const Image& reference, const std::filesystem::path& image_file,
                               const std::filesystem::path& reference_file)
{
    if (image.width != reference.width || image.height != reference.height)
        throw FileError(fmt::format("{} is {}x{} but {} is {}x{}; compare images of one size", image_file.string(), image.width, image.height,
                                    reference_file.string(), reference.width, reference.height));
    const RgbChannels rgb_a = rgb_channels(image, image_file), rgb_b = rgb_channels(reference, reference_file);
    const std::array<std::pair<int, int>, 3> channels{{{rgb_a.r, rgb_b.r}, {rgb_a.g, rgb_b.g}, {rgb_a.b, rgb_b.b}}};

    // Sums by row first: keeps the rounding of large images at the level of one row's.
    double squares = 0, relative = 0, absolute = 0, sum_a = 0, sum_b = 0;
    for (int y = 0; y < image.height; ++y) {
        double row_squares = 0, row_relative = 0, row_absolute = 0, row_a = 0, row_b = 0;
        for (int x = 0; x < image.width; ++x) {
            for (const auto& [channel_a, channel_b] : channels) {
                const float value_a = image.at(x, y, channel_a), value_b = reference.at(x, y, channel_b);
                if (!std::isfinite(value_a)) refuse_pixel(image_file, x, y, value_a);
                if (!std::isfinite(value_b)) refuse_pixel(reference_file, x, y, value_b);
                const double a = value_a, b = value_b, d = a - b;
                row_squares += d * d;
                row_relative += d * d / (b * b + relmse_floor);
                row_absolute += std::abs(d);
                row_a += a;
                row_b += b;
            }
        }
        squares += row_squares;
        relative += row_relative;
        absolute += row_absolute;
        sum_a += row_a;
        sum_b += row_b;
    }

    const double count = 3.0 * image.width * image.height;
    ImageDifference difference;
    difference.mse = squares / count;
    difference.rmse = std::sqrt(difference.mse);
    difference.relmse = relative / count;
    difference.mae = absolute / count;
    difference.mean_ratio = sum_a == sum_b ? 1.0 : sum_a / sum_b;
    return difference;
}

} // namespace sundog
