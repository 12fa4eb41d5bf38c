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

ProgressiveStatistics::ProgressiveStatistics(Device& device, std::size_t count, float first_radius, double alpha)
    : alpha_(static_cast<float>(alpha)),
      set_query_radii_(device, "set_query_radii", "Set query radii", BuildOptions{{{"PIXEL_STATISTICS", "ProgressivePixel"}}, {}}),
      update_progressive_pixels_(device, "update_progressive_pixels", "Update progressive pixels"),
      pixels_(device, first_statistics(count, first_radius), "progressive pixels")
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
                               pixels_, direct);
}

void ProgressiveStatistics::update(const Buffer<GatherQuery>& queries, const Buffer<GatherSum>& sums, const Buffer<Vec3>& direct,
                                   float inverse_paths, float share, Buffer<Vec3>& radiance)
{
    update_progressive_pixels_(pixels_.size(), queries, sums, direct, static_cast<uint>(pixels_.size()), alpha_, inverse_paths * share,
                               share, pixels_, radiance);
}

void ProgressiveStatistics::add_radiance(Image& image, const DeviceFilm& film, std::size_t light_paths, double share) const
{
    const std::vector<ProgressivePixel> pixels = pixels_.download();
    const double iterations = static_cast<double>(film.iterations());
    const double emitted = iterations * static_cast<double>(light_paths);
    for (std::size_t path = 0; path < pixels.size(); path++) {
        const ProgressivePixel& p = pixels[path];
        const double density = 1.0 / (std::numbers::pi * static_cast<double>(p.radius_squared) * emitted);
        const auto radiance = [&](float tau, float direct, float direct_error) {
            return static_cast<float>(share * ((static_cast<double>(direct) + direct_error) / iterations + tau * density));
        };
        float* out = &image.pixels[film.pixel_of_path(path) * image.channels.size()];
        out[0] += radiance(p.tau.x, p.direct.x, p.direct_error.x);
        out[1] += radiance(p.tau.y, p.direct.y, p.direct_error.y);
        out[2] += radiance(p.tau.z, p.direct.z, p.direct_error.z);
    }
}

void clear_radiance(Image& image)
{
    for (std::size_t i = 0; i < image.pixels.size(); i += image.channels.size())
        for (std::size_t c = 0; c < 3; c++) image.pixels[i + c] = 0.0f;
}

} // namespace sundog
