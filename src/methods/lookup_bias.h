// The bias of what one photon map answers, iteration by iteration.
#pragma once

#include "methods/bias_estimate.h"
#include "stages/fixed_photon_map.h"

#include <variant>

namespace sundog
{

class LookupBias
{
public:
    // Of lookups as these, in maps of each iteration's own photons. There must be an error estimate in the film.
    LookupBias(RenderContext& context, const PhotonLookup& lookup);

    // Of queries that the map has just answered, and their lobes. The map is left sorted for others.
    void add(FixedPhotonMap& map, const Buffer<GatherQuery>& queries, const Buffer<LobeRecord>& lobes, std::uint64_t iteration);

private:
    std::variant<BiasEstimate, NearestBiasEstimate> estimate_;
};

} // namespace sundog
