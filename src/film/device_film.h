// The film on the device: what iterations add up to.
#pragma once

#include "base/state_archive.h"
#include "device/kernel.h"
#include "film/error_estimate.h"
#include "film/image.h"
#include "shared/film.h"

#include <cstdint>
#include <optional>

namespace sundog {

// One entry a pixel of the crop, in path order (kernels/scene/camera_rays.h: tiles).
class DeviceFilm {
public:
    DeviceFilm(Device& device, int width, int height);

    // Methods call it before they change what outlives the iteration, other than by accumulate(): from there to the end of
    // accumulate() the render's state is that of no whole number of iterations.
    void begin_update() { is_whole_ = false; }
    bool is_whole() const { return is_whole_; }

    // Whether first hits lack this iteration's, which the caller adds. A pass that failed and is made again finds its own there.
    bool begin_first_hits(std::uint64_t iteration);

    // Adds one iteration's radiance (W/m^2/sr, one a pixel). Samples that are not finite are counted and left out.
    void accumulate(const Buffer<Vec3>& radiance);

    Buffer<FirstHitPixel> first_hits; // means, updated by camera paths
    std::optional<ErrorEstimate> errors; // where they were asked for, before the first iteration

    RelativeError relative_error() const { return errors->relative_error(pixels_, iterations_); } // waits

    std::uint64_t iterations() const { return iterations_; }
    std::uint64_t invalid_samples() const; // waits
    int width() const { return width_; }
    int height() const { return height_; }
    std::size_t pixel_count() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }

    // Means of radiance, variance.{R,G,B} (of one iteration's radiance, unbiased), albedo, N and depth, and the error estimate's channels.
    Image resolve() const;

    // All that iterations have added up.
    void serialize(StateArchive& archive);

    // Row-major index of the pixel with this place in path order.
    std::size_t pixel_of_path(std::size_t path) const;

private:
    void resolve_paths(std::size_t first, std::size_t count, Image& image) const;

    int width_;
    int height_;
    Kernel accumulate_film_;
    Buffer<FilmPixel> pixels_;
    Buffer<uint> invalid_samples_;
    std::uint64_t iterations_ = 0;
    std::uint64_t first_hit_iterations_ = 0; // the same, or one more after a pass that failed
    bool is_whole_ = true;
};

// Whether finite sums of n values have a finite mean, and variance where squares do not overflow.
bool is_sum(const FilmPixel& pixel);

} // namespace sundog
