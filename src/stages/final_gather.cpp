#include "stages/final_gather.h"

namespace sundog
{

FinalGather::FinalGather(Device& device, const DeviceScene& scene, std::size_t capacity, PathRules rules, SamplerKind sampler)
    : queries(device, std::vector<GatherQuery>(capacity, GatherQuery{}), "final gather queries"),
      lobes(device, scene.has_lobes_to_evaluate() ? capacity : 1, "final gather lobes"), rules_(rules),
      set_query_radius_(device, "set_query_radius", "Set query radius")
{
    BuildOptions options = scene.surface_options();
    use_sampler(options, sampler);
    begin_final_gather_ = Kernel(device, "begin_final_gather", "Begin final gather", options);
    shade_gather_path_ = Kernel(device, "shade_gather_path", "Shade gather paths", options);
}

void FinalGather::trace(const DeviceScene& scene, const CameraPaths& camera, const QueryTracer& visible, PathPool& pool, SamplerKey key,
                        float radius)
{
    const uint count = static_cast<uint>(camera.count());
    set_query_radius_(count, 0.0f, count, queries);
    begin_final_gather_(count, scene.surfaces(), key, rules_, count, visible.queries, pool.hits, pool.rays, pool.paths, pool.active(),
                        pool.flags);
    pool.start(count);
    while (pool.keep_alive()) {
        pool.trace(scene);
        shade_gather_path_(pool.items(), scene.surfaces(), key, rules_, radius, pool.hits, pool.active(), pool.active_count(), pool.rays,
                           pool.paths, queries, lobes, pool.flags);
    }
}

} // namespace sundog
