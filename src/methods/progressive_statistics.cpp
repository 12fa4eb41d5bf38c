#include "methods/progressive_statistics.h"

#include "math/plausible.h"
#include "methods/radius_policy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sundog
{

namespace
{

// The image is all that needs room for every pixel.
constexpr std::size_t pixels_at_a_time = 65536;

std::vector<ProgressivePixel> first_statistics(std::size_t count, float first_radius)
{
    ProgressivePixel pixel{};
    pixel.radius_squared = first_radius * first_radius;
    return std::vector<ProgressivePixel>(count, pixel);
}

} // namespace

ProgressiveStatistics::ProgressiveStatistics(Device& device, std::size_t count, float first_radius, double alpha, DirectLight direct)
    : direct_light_(direct), alpha_(static_cast<float>(alpha)), first_radius_(first_radius),
      set_query_radii_(device, "set_query_radii", "Set query radii", BuildOptions{{{"PIXEL_STATISTICS", "ProgressivePixel"}}, {}}),
      update_progressive_pixels_(device, "update_progressive_pixels", "Update progressive pixels",
                                 BuildOptions{{{"SUMS_DIRECT", direct == DirectLight::varying ? "1" : "0"}}, {}}),
      pixels_(device, first_statistics(count, first_radius), "progressive pixels"),
      direct_sums_(device, std::vector<DirectSum>(direct == DirectLight::varying ? count : 1), "sums of direct light")
{
}

void ProgressiveStatistics::set_radii(const Buffer<GatherQuery>& queries)
{
    set_query_radii_(pixels_.size(), pixels_, static_cast<uint>(pixels_.size()), queries);
}

void ProgressiveStatistics::update(const Buffer<GatherQuery>& queries, const Buffer<GatherSum>& sums, Buffer<Vec3>& direct,
                                   float inverse_paths)
{
    update_progressive_pixels_(pixels_.size(), queries, sums, direct, static_cast<uint>(pixels_.size()), alpha_, inverse_paths, 0.0f,
                               pixels_, direct_sums_, direct);
}

void ProgressiveStatistics::update(const Buffer<GatherQuery>& queries, const Buffer<GatherSum>& sums, const Buffer<Vec3>& direct,
                                   float inverse_paths, float share, Buffer<Vec3>& radiance)
{
    update_progressive_pixels_(pixels_.size(), queries, sums, direct, static_cast<uint>(pixels_.size()), alpha_, inverse_paths * share,
                               share, pixels_, direct_sums_, radiance);
}

std::vector<Double3> ProgressiveStatistics::mean_direct(const Buffer<Vec3>& direct, std::size_t first, std::size_t count,
                                                        std::uint64_t iterations) const
{
    std::vector<Double3> means;
    means.reserve(count);
    if (direct_light_ == DirectLight::constant) {
        // What is not finite the film counts, and no image shows.
        for (const Vec3 d : direct.download(first, count)) means.push_back(is_finite(d) ? difference(d, {0, 0, 0}) : Double3{});
        return means;
    }
    const double n = static_cast<double>(iterations);
    for (const DirectSum& d : direct_sums_.download(first, count))
        means.push_back({(static_cast<double>(d.sum.x) + d.error.x) / n, (static_cast<double>(d.sum.y) + d.error.y) / n,
                         (static_cast<double>(d.sum.z) + d.error.z) / n});
    return means;
}

void ProgressiveStatistics::add_radiance(Image& image, const DeviceFilm& film, const Buffer<Vec3>& direct, std::size_t light_paths,
                                         double share) const
{
    const double emitted = static_cast<double>(film.iterations()) * static_cast<double>(light_paths);
    for (std::size_t first = 0; first < pixels_.size(); first += pixels_at_a_time) {
        const std::vector<ProgressivePixel> pixels = pixels_.download(first, std::min(pixels_at_a_time, pixels_.size() - first));
        const std::vector<Double3> means = mean_direct(direct, first, pixels.size(), film.iterations());
        for (std::size_t i = 0; i < pixels.size(); i++) {
            const ProgressivePixel& p = pixels[i];
            const double density = 1.0 / (std::numbers::pi * static_cast<double>(p.radius_squared) * emitted);
            const auto radiance = [&](float tau, double mean) { return static_cast<float>(share * (mean + tau * density)); };
            float* out = &image.pixels[film.pixel_of_path(first + i) * image.channels.size()];
            out[0] += radiance(p.tau.x, means[i][0]);
            out[1] += radiance(p.tau.y, means[i][1]);
            out[2] += radiance(p.tau.z, means[i][2]);
        }
    }
}

void ProgressiveStatistics::serialize(StateArchive& archive)
{
    sundog::serialize(archive, "progressive pixels", pixels_, [this](const ProgressivePixel& pixel) {
        return is_shrunk(pixel.radius_squared, first_radius_) && is_plausible(pixel.tau * (1.0f / pixel.radius_squared)) && pixel.count >= 0.0f && std::isfinite(pixel.count) &&
               std::isfinite(pixel.count_error);
    });
    if (direct_light_ == DirectLight::varying)
        sundog::serialize(archive, "sums of direct light", direct_sums_,
                          [](const DirectSum& direct) { return is_plausible(direct.sum) && is_plausible(direct.error); });
}

void clear_radiance(Image& image)
{
    for (std::size_t i = 0; i < image.pixels.size(); i += image.channels.size())
        for (std::size_t c = 0; c < 3; c++) image.pixels[i + c] = 0.0f;
}

} // namespace sundog
