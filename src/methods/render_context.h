// What every method renders with.
#pragma once

#include "base/interrupt.h"
#include "film/device_film.h"
#include "stages/camera_paths.h"
#include "stages/spectral_transport.h"

#include <functional>
#include <string>

namespace sundog {

struct RenderContext {
    Device& device;
    const DeviceScene& scene;
    const Camera& camera; // moves from pass to pass, as does the scene: both are where they belong when a pass begins
    const PixelFilter& filter;
    DeviceFilm& film;
    const SpectralTransport& spectral; // its pass begins before the method's
    std::uint64_t seed;
    std::function<std::string()> light_fingerprint; // of the scene without its camera (scene/fingerprint.h); takes a while
    std::function<bool()> stop_requested;           // asked between the parts of what takes long (is_interrupted)
};

// Then a method may throw Interrupted, once what it keeps is as it was before the iteration.
inline bool is_interrupted(const RenderContext& context)
{
    return context.stop_requested && context.stop_requested();
}

} // namespace sundog
