// Photons that are traced once, before the first iteration, or come from a file.
#pragma once

#include "methods/parameters.h"
#include "methods/render_context.h"
#include "stages/light_paths.h"

#include <optional>

namespace sundog
{

class ImportanceMap;

struct TracedPhotons {
    std::vector<Photon> photons;   // in the order of their batches, bounces and paths
    std::uint64_t light_paths = 0; // emitted: settings.paths, or a few more
    std::uint64_t rays = 0;
};

// Light paths in batches of equal size, so that memory does not grow with their number. Maps of one render that are to be
// independent of each other have different numbers. With `importance` only the photons that survive by it are returned.
TracedPhotons trace_photons(RenderContext& context, PhotonTracerSettings settings, uint map_number, ImportanceMap* importance = nullptr);

// What the maps of photonmapper hold. Without caustic map: nothing in the scene focuses light.
struct MapPhotons {
    TracedPhotons global;
    std::optional<TracedPhotons> caustic;
};

// Traced as the parameters say, or read from load_map; and written to save_map. Throws FileError.
MapPhotons make_map_photons(RenderContext& context, const Parameters& parameters);

} // namespace sundog
