#include "film/error_estimate.h"

#include "device/buffer_state.h"
#include "film/device_film.h"
#include "film/moments.h"
#include "math/student_t.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sundog
{

namespace
{

// Partial sums that a reduction leaves to the host: enough for a GPU, and pixels enough for each.
constexpr std::size_t most_partial_sums = 4096;
constexpr std::size_t pixels_a_sum = 64;

BuildOptions bound_options(bool biased)
{
    return {{{"BIASED", biased ? "1" : "0"}}, {}};
}

const float* component(const Vec3& v, int c)
{
    return c == 0 ? &v.x : c == 1 ? &v.y : &v.z;
}

Moments channel_moments(const FilmPixel& p, int c, double n)
{
    return moments(*component(p.sum, c), *component(p.sum_error, c), *component(p.squares, c), *component(p.squares_error, c), n);
}

int channel_index(const Image& image, const std::string& name)
{
    const auto found = std::find(image.channels.begin(), image.channels.end(), name);
    return found == image.channels.end() ? -1 : static_cast<int>(found - image.channels.begin());
}

} // namespace

double RelativeError::expected() const
{
    return std::sqrt(bias * bias + noise * noise);
}

ErrorEstimate::ErrorEstimate(Device& device, std::size_t pixels, bool biased, double confidence)
    : confidence_(confidence), sum_error_bounds_(device, "sum_error_bounds", "Sum error bounds", bound_options(biased)),
      sums_(device, std::clamp<std::size_t>(pixels / pixels_a_sum, 1, most_partial_sums), "error sums")
{
    if (!biased) return;
    accumulate_corrected_ = Kernel(device, "accumulate_corrected", "Accumulate errors");
    bias = Buffer<Vec3>(device, std::vector<Vec3>(pixels), "bias");
    corrected_ = Buffer<FilmPixel>(device, std::vector<FilmPixel>(pixels), "corrected film");
}

void ErrorEstimate::accumulate(const Buffer<Vec3>& radiance)
{
    if (biased()) accumulate_corrected_(bias.size(), radiance, static_cast<uint>(bias.size()), bias, corrected_);
}

double ErrorEstimate::quantile(std::uint64_t n) const
{
    return student_t_quantile(0.5 * (1.0 - confidence_), static_cast<double>(n - 1));
}

RelativeError ErrorEstimate::relative_error(const Buffer<FilmPixel>& film, std::uint64_t n) const
{
    constexpr double infinite = std::numeric_limits<double>::infinity();
    if (n < 2) return {infinite, infinite, infinite};
    sum_error_bounds_(sums_.size(), film, biased() ? corrected_ : film, static_cast<uint>(film.size()), static_cast<float>(n),
                      static_cast<float>(quantile(n)), static_cast<uint>(sums_.size()), sums_);
    double bound = 0.0, bias_squares = 0.0, noise = 0.0;
    for (const RelativeSquares& sum : sums_.download()) {
        bound += sum.bound;
        bias_squares += sum.bias;
        noise += sum.noise;
    }
    const double values = 3.0 * static_cast<double>(film.size());
    return {std::sqrt(bound / values), std::sqrt(bias_squares / values), std::sqrt(noise / values)};
}

std::vector<std::string> ErrorEstimate::channel_names() const
{
    if (biased()) return {"error.R", "error.G", "error.B", "bias.R", "bias.G", "bias.B"};
    return {"error.R", "error.G", "error.B"};
}

std::vector<float> ErrorEstimate::channels(const std::vector<FilmPixel>& film, std::size_t first, std::uint64_t n) const
{
    const std::vector<FilmPixel> corrected = biased() ? corrected_.download(first, film.size()) : std::vector<FilmPixel>();
    const double count = static_cast<double>(n);
    const double width = n < 2 ? std::numeric_limits<double>::infinity() : quantile(n) / std::sqrt(count);
    std::vector<float> values;
    values.reserve(film.size() * channel_names().size());
    for (std::size_t path = 0; path < film.size(); path++) {
        float errors[3], biases[3];
        for (int c = 0; c < 3; c++) {
            const Moments seen = channel_moments(film[path], c, count);
            const Moments unbiased = biased() ? channel_moments(corrected[path], c, count) : seen;
            biases[c] = static_cast<float>(seen.mean - unbiased.mean);
            errors[c] = n < 2 ? std::numeric_limits<float>::infinity()
                              : static_cast<float>(std::abs(seen.mean - unbiased.mean) + width * std::sqrt(unbiased.variance));
        }
        values.insert(values.end(), errors, errors + 3);
        if (biased()) values.insert(values.end(), biases, biases + 3);
    }
    return values;
}

// The bias of an iteration is no state: it is 0 between iterations.
void ErrorEstimate::serialize(StateArchive& archive)
{
    if (biased()) sundog::serialize(archive, "corrected film", corrected_, is_sum);
}

std::vector<double> relative_bounds(const Image& image)
{
    std::vector<double> bounds(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    for (const std::string color : {"R", "G", "B"}) {
        const int value = channel_index(image, color), error = channel_index(image, "error." + color);
        for (std::size_t i = 0; i < bounds.size(); i++) {
            const float* pixel = &image.pixels[i * image.channels.size()];
            const double radiance = pixel[value], bound = pixel[error];
            bounds[i] += bound * bound / (radiance * radiance + RELATIVE_ERROR_OFFSET);
        }
    }
    for (double& bound : bounds) bound = std::sqrt(bound / 3.0);
    return bounds;
}

double relative_bound(const Image& image)
{
    const std::vector<double> bounds = relative_bounds(image);
    double sum = 0.0;
    for (const double bound : bounds) sum += bound * bound;
    return std::sqrt(sum / static_cast<double>(bounds.size()));
}

} // namespace sundog
