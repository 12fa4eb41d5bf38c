// What every method renders with.
#pragma once

#include "film/device_film.h"
#include "stages/camera_paths.h"
#include "stages/spectral_transport.h"

namespace sundog {

struct RenderContext {
    Device& device;
    const DeviceScene& scene;
    const Camera& camera; // moves from pass to pass, as does the scene: both are where they belong when a pass begins
    const PixelFilter& filter;
    DeviceFilm& film;
    const SpectralTransport& spectral; // its pass begins before the method's
    std::uint64_t seed;
};

} // namespace sundog
