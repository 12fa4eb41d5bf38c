// Local progressive statistics: of each pixel, or hit point, its radius, the photons and the flux that it has found
// [Hachisuka, Ogaki and Jensen 2008; Hachisuka and Jensen 2009].
#pragma once

#include "device/buffer_state.h"
#include "device/kernel.h"
#include "film/device_film.h"
#include "math/double3.h"
#include "methods/parameters.h"
#include "shared/photon.h"

namespace sundog
{

// Radiance that is not from photons: a fixed hit point's is the same in all iterations, and needs no sum.
enum class DirectLight { constant, varying };

class ProgressiveStatistics
{
public:
    // count: of pixels, in path order; first_radius: in scene units; alpha: the share of new photons that are kept.
    ProgressiveStatistics(Device& device, std::size_t count, float first_radius, double alpha, DirectLight direct);

    void set_radii(const Buffer<GatherQuery>& queries);

    // Adds one iteration: what queries found, and the radiance that is not from photons (`direct`, W/m^2/sr). Also adds
    // the iteration's own estimate, 1 / inverse_paths light subpaths strong, to `radiance`, which is `direct`.
    void update(const Buffer<GatherQuery>& queries, const Buffer<GatherSum>& sums, Buffer<Vec3>& direct, float inverse_paths);

    // The same for one of several hit points of a pixel: adds `share` of the iteration's own estimate to `radiance`.
    void update(const Buffer<GatherQuery>& queries, const Buffer<GatherSum>& sums, const Buffer<Vec3>& direct, float inverse_paths,
                float share, Buffer<Vec3>& radiance);

    // Adds share * L to the image, L = direct + tau / (pi r^2 N) by eq. 10 of the later paper. direct: that of the last
    // iteration, which counts where it is constant; light_paths: an iteration's.
    void add_radiance(Image& image, const DeviceFilm& film, const Buffer<Vec3>& direct, std::size_t light_paths, double share) const;

    void serialize(StateArchive& archive);

private:
    // Means over iterations, of `count` paths from `first` on.
    std::vector<Double3> mean_direct(const Buffer<Vec3>& direct, std::size_t first, std::size_t count, std::uint64_t iterations) const;

    DirectLight direct_light_;
    float alpha_, first_radius_;
    Kernel set_query_radii_;
    Kernel update_progressive_pixels_;
    Buffer<ProgressivePixel> pixels_;
    Buffer<DirectSum> direct_sums_; // one, unused, where it is constant
};

// Sets the image's radiance, its first three channels, to zero.
void clear_radiance(Image& image);

} // namespace sundog
