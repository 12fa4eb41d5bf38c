#include "stages/query_paths.h"

namespace sundog
{

namespace
{

// Of paths at narrow lobes that ask for photons there rather than go on. Both kinds are needed, and neither is rare.
constexpr float narrow_query_share = 0.5f;

} // namespace

QueryTracer::QueryTracer(Device& device, const DeviceScene& scene, std::size_t capacity, PathRules rules, bool direct_light,
                         SamplerKind sampler)
    : queries(device, capacity, "gather queries"), lobes(device, scene.has_lobes_to_evaluate() ? capacity : 1, "query lobes"),
      rules_(rules), direct_light_(direct_light), shadow_(device, scene, direct_light ? capacity : 1, true)
{
    BuildOptions options = scene.surface_options();
    use_sampler(options, sampler);
    options.defines.emplace_back("DIRECT_LIGHT", direct_light ? "1" : "0");
    shade_query_path_ = Kernel(device, "shade_query_path", "Shade query paths", options);
}

void QueryTracer::trace(const DeviceScene& scene, CameraPaths& camera, PathPool& pool, SamplerKey key, float radius)
{
    for (;;) {
        shade_query_path_(pool.items(), scene.surfaces(), key, rules_, radius, scene.has_delta_lights() ? narrow_query_share : 0.0f,
                          pool.hits, pool.active(), pool.active_count(), pool.rays, pool.paths, camera.radiance, shadow_.rays,
                          shadow_.radiance, queries, lobes, pool.flags);
        if (direct_light_) {
            shadow_.trace(scene, pool);
            shadow_.add_unoccluded(pool, camera.radiance);
        }
        if (!pool.keep_alive()) break;
        pool.trace(scene);
    }
}

} // namespace sundog
