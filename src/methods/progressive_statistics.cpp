#include "methods/progressive_statistics.h"

#include <numbers>

namespace sundog
{

namespace
{

std::vector<ProgressivePixel> first_statistics(std::size_t count, float first_radius)
{
    ProgressivePixel pixel{};
    pixel.radius_squared = first_radius * first_radius;
    return std::vector<ProgressivePixel>(count, pixel);
}

} // namespace

ProgressiveStatistics::ProgressiveStatistics(Device& device, std::size_t count, float first_radius, double alpha, DirectLight direct)
    : direct_light_(direct), alpha_(static_cast<float>(alpha)),
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

std::vector<Double3> ProgressiveStatistics::mean_direct(const Buffer<Vec3>& direct, std::uint64_t iterations) const
{
    std::vector<Double3> means;
    means.reserve(pixels_.size());
    if (direct_light_ == DirectLight::constant) {
        // What is not finite the film counts, and no image shows.
        for (const Vec3 d : direct.download()) means.push_back(is_finite(d) ? difference(d, {0, 0, 0}) : Double3{});
        return means;
    }
    const double n = static_cast<double>(iterations);
    for (const DirectSum& d : direct_sums_.download())
        means.push_back({(static_cast<double>(d.sum.x) + d.error.x) / n, (static_cast<double>(d.sum.y) + d.error.y) / n,
                         (static_cast<double>(d.sum.z) + d.error.z) / n});
    return means;
}

void ProgressiveStatistics::add_radiance(Image& image, const DeviceFilm& film, const Buffer<Vec3>& direct, std::size_t light_paths,
                                         double share) const
{
    const std::vector<ProgressivePixel> pixels = pixels_.download();
    const std::vector<Double3> means = mean_direct(direct, film.iterations());
    const double emitted = static_cast<double>(film.iterations()) * static_cast<double>(light_paths);
    for (std::size_t path = 0; path < pixels.size(); path++) {
        const ProgressivePixel& p = pixels[path];
        const double density = 1.0 / (std::numbers::pi * static_cast<double>(p.radius_squared) * emitted);
        const auto radiance = [&](float tau, double mean) { return static_cast<float>(share * (mean + tau * density)); };
        float* out = &image.pixels[film.pixel_of_path(path) * image.channels.size()];
        out[0] += radiance(p.tau.x, means[path][0]);
        out[1] += radiance(p.tau.y, means[path][1]);
        out[2] += radiance(p.tau.z, means[path][2]);
    }
}

void ProgressiveStatistics::serialize(StateArchive& archive)
{
    sundog::serialize(archive, "progressive pixels", pixels_);
    if (direct_light_ == DirectLight::varying) sundog::serialize(archive, "sums of direct light", direct_sums_);
}

void clear_radiance(Image& image)
{
    for (std::size_t i = 0; i < image.pixels.size(); i += image.channels.size())
        for (std::size_t c = 0; c < 3; c++) image.pixels[i + c] = 0.0f;
}

} // namespace sundog
