#include "stages/unbiased_gathering.h"

#include "base/errors.h"

#include <algorithm>

namespace sundog
{

namespace
{

constexpr std::size_t pairs_per_path = 2;
// Places in the list of a bounce have 32 bits; counts that need more stay at the largest.
constexpr std::size_t most_pairs = 0xffffffffu;

} // namespace

UnbiasedGathering::UnbiasedGathering(Device& device, const DeviceScene& scene, std::size_t paths, PathRules rules)
    : near_(device, scene, paths), pairs_(device, scene, paths, pairs_per_path * paths, rules),
      trials_(device, scene, pairs_per_path * paths, rules),
      weigh_near_pairs_(device, "weigh_near_pairs", "Weigh near photons", scene.surface_options())
{
}

void UnbiasedGathering::gather(const DeviceScene& scene, const ConnectedSubpaths& subpaths, Buffer<Vec3>& radiance)
{
    const std::size_t total = near_.count(subpaths);
    if (total >= most_pairs)
        throw UsageError("more than 2^32 photons are near the rays of one bounce: choose a smaller radius (-p radius=R) or fewer light subpaths "
                         "(-p photons=N)");
    for (std::size_t window = 0; window < total; window += pairs_.capacity()) {
        const std::size_t count = std::min(pairs_.capacity(), total - window);
        near_.list(subpaths, window, pairs_.firsts, pairs_.pairs);
        pairs_.connect(scene, subpaths, 1.0f, count);
        trials_.run(scene, subpaths, pairs_, count, near_.radius());
        weigh_near_pairs_(count, near_.radius(), static_cast<uint>(count), pairs_.pairs, subpaths.camera_subpaths.vertices,
                          subpaths.light_subpaths.vertices(), trials_.states(), pairs_.radiance);
        pairs_.add_to(radiance, subpaths.pool, window, count);
    }
}

} // namespace sundog
