#include "methods/lookup_bias.h"

namespace sundog
{

namespace
{

std::variant<BiasEstimate, NearestBiasEstimate> make_estimate(RenderContext& context, const PhotonLookup& lookup)
{
    if (lookup.nearest > 0) return NearestBiasEstimate(context, lookup.nearest);
    return BiasEstimate(context, lookup.radius);
}

} // namespace

LookupBias::LookupBias(RenderContext& context, const PhotonLookup& lookup) : estimate_(make_estimate(context, lookup)) {}

void LookupBias::add(FixedPhotonMap& map, const Buffer<GatherQuery>& queries, const Buffer<LobeRecord>& lobes, std::uint64_t iteration)
{
    const GatheredWith gathered_with{map.lookup().density_kernel, map.inverse_paths()};
    if (auto* nearest = std::get_if<NearestBiasEstimate>(&estimate_)) {
        nearest->add(map.photons(), queries, lobes, gathered_with);
        return;
    }
    auto& within_radius = std::get<BiasEstimate>(estimate_);
    map.sort_again(within_radius.map_radius(iteration, map.lookup().radius));
    within_radius.add(map.photons(), queries, lobes, iteration, gathered_with);
}

} // namespace sundog
