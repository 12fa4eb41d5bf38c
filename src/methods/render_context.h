// What every method renders with.
#pragma once

#include "film/device_film.h"
#include "stages/camera_paths.h"
#include "stages/device_scene.h"

namespace sundog {

struct RenderContext {
    Device& device;
    const DeviceScene& scene;
    const Camera& camera;
    const PixelFilter& filter;
    DeviceFilm& film;
    std::uint64_t seed;
};

} // namespace sundog
