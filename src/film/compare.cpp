#include "film/compare.h"

#include "base/errors.h"
#include "film/image_io.h"
#include "math/srgb.h"
#include "scene/color_channels.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <span>
#include <vector>

namespace sundog {

namespace {

constexpr double relmse_floor = 0.01; // the contract's; keeps black pixels finite

void check_sizes(int width, int height, int reference_width, int reference_height, const std::filesystem::path& image_file,
                 const std::filesystem::path& reference_file)
{
    if (width != reference_width || height != reference_height)
        throw FileError(fmt::format("{} is {}x{} but {} is {}x{}; compare images of one size", image_file.string(), width, height, reference_file.string(),
                                    reference_width, reference_height));
}

// Linear colours of a row's samples.
void read_colors(std::span<const float> samples, std::size_t channels, const ColorChannels& color, bool encoded, std::vector<Vec3>& row)
{
    row.clear();
    const auto linear = [&](float value) { return encoded ? linear_from_srgb(value) : value; };
    const auto [r, g, b] = color.index;
    for (std::size_t i = 0; i < samples.size(); i += channels)
        row.push_back(color.color({linear(samples[i + r]), linear(samples[i + g]), linear(samples[i + b])}));
}

// Linear colours of a file's rows.
class ColorRows {
public:
    explicit ColorRows(const std::filesystem::path& path)
        : file_(open_image_file(path)), color_(color_channels(file_->header().channels, path)), encoded_(holds_srgb(file_->header()))
    {
    }

    int width() const { return file_->header().width; }
    int height() const { return file_->header().height; }
    void read(std::vector<Vec3>& row)
    {
        read_colors(file_->next_row(), file_->header().channels.size(), color_, encoded_, row);
    }

private:
    std::unique_ptr<ImageFile> file_;
    ColorChannels color_;
    bool encoded_;
};

class DifferenceSums {
public:
    DifferenceSums(const std::filesystem::path& image_file, const std::filesystem::path& reference_file)
        : image_file_(image_file), reference_file_(reference_file)
    {
    }

    // Sums by row first: keeps the rounding of large images at the level of one row's.
    void add_row(std::span<const Vec3> image, std::span<const Vec3> reference)
    {
        double squares = 0, relative = 0, absolute = 0, sum_a = 0, sum_b = 0;
        for (std::size_t x = 0; x < image.size(); ++x) {
            check_finite(image[x], x, image_file_);
            check_finite(reference[x], x, reference_file_);
            for (const auto channel : {&Vec3::x, &Vec3::y, &Vec3::z}) {
                const double a = image[x].*channel, b = reference[x].*channel, d = a - b;
                squares += d * d;
                relative += d * d / (b * b + relmse_floor);
                absolute += std::abs(d);
                sum_a += a;
                sum_b += b;
            }
        }
        squares_ += squares;
        relative_ += relative;
        absolute_ += absolute;
        sum_a_ += sum_a;
        sum_b_ += sum_b;
        count_ += 3.0 * static_cast<double>(image.size());
        y_++;
    }

    ImageDifference difference() const
    {
        ImageDifference difference;
        difference.mse = squares_ / count_;
        difference.rmse = std::sqrt(difference.mse);
        difference.relmse = relative_ / count_;
        difference.mae = absolute_ / count_;
        difference.mean_ratio = sum_a_ == sum_b_ ? 1.0 : sum_a_ / sum_b_;
        return difference;
    }

private:
    void check_finite(Vec3 color, std::size_t x, const std::filesystem::path& file) const
    {
        for (const float value : {color.x, color.y, color.z})
            if (!std::isfinite(value))
                throw FileError(fmt::format("{}: pixel ({}, {}) is {}; only finite images can be compared", file.string(), x, y_, value));
    }

    std::filesystem::path image_file_, reference_file_;
    double squares_ = 0, relative_ = 0, absolute_ = 0, sum_a_ = 0, sum_b_ = 0, count_ = 0;
    int y_ = 0;
};

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
    check_sizes(image.width, image.height, reference.width, reference.height, image_file, reference_file);
    const ColorChannels color_a = color_channels(image.channels, image_file), color_b = color_channels(reference.channels, reference_file);
    DifferenceSums sums(image_file, reference_file);
    std::vector<Vec3> row_a, row_b;
    const auto read = [](const Image& from, int y, const ColorChannels& color, std::vector<Vec3>& row) {
        const std::size_t samples = static_cast<std::size_t>(from.width) * from.channels.size();
        const auto in_row = std::span(from.pixels).subspan(static_cast<std::size_t>(y) * samples, samples);
        read_colors(in_row, from.channels.size(), color, false, row);
    };
    for (int y = 0; y < image.height; ++y) {
        read(image, y, color_a, row_a);
        read(reference, y, color_b, row_b);
        sums.add_row(row_a, row_b);
    }
    return sums.difference();
}

ImageDifference compare_files(const std::filesystem::path& image_file, const std::filesystem::path& reference_file)
{
    ColorRows image(image_file), reference(reference_file);
    check_sizes(image.width(), image.height(), reference.width(), reference.height(), image_file, reference_file);
    DifferenceSums sums(image_file, reference_file);
    std::vector<Vec3> row_a, row_b;
    for (int y = 0; y < image.height(); ++y) {
        image.read(row_a);
        reference.read(row_b);
        sums.add_row(row_a, row_b);
    }
    return sums.difference();
}

} // namespace sundog
