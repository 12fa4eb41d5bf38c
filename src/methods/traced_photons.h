// Photons that are traced once, before the first iteration.
#pragma once

#include "methods/render_context.h"
#include "stages/light_paths.h"

namespace sundog
{

struct TracedPhotons {
    std::vector<Photon> photons;   // in the order of their batches, bounces and paths
    std::uint64_t light_paths = 0; // emitted: settings.paths, or a few more
    std::uint64_t rays = 0;
};

// Light paths in batches of equal size, so that memory does not grow with their number. Maps of one render that are to be
// independent of each other have different numbers.
TracedPhotons trace_photons(RenderContext& context, PhotonTracerSettings settings, uint map_number);

} // namespace sundog
