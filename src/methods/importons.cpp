#include "methods/importons.h"

#include "methods/light_pass.h"
#include "methods/photon_map_parameters.h"
#include "stages/final_gather.h"

namespace sundog
{

ParameterSpec importons_spec()
{
    return {
        "importons",
        ParameterType::integer,
        "0",
        "camera subpaths",
        "Camera paths traced ahead to find where photons matter; elsewhere nine in ten are left out (Peter and Pietrek 1998). 0: all stay.",
        0,
        4e9,
        {},
        sizeof(Photon)};
}

std::unique_ptr<ImportanceMap> trace_importons(RenderContext& context, const Parameters& parameters, std::uint64_t& rays)
{
    const auto wanted = static_cast<std::size_t>(parameters.integer("importons"));
    if (wanted == 0) return nullptr;
    Device& device = context.device;
    const DeviceScene& scene = context.scene;
    CameraPaths camera(device, context.camera, context.filter, sampler_kind(parameters), scene.surface_options());
    PathPool pool(device, scene, camera.count());
    QueryTracer visible(device, scene, camera.count(), query_rules(parameters), false, sampler_kind(parameters));
    FinalGather gather(device, scene, camera.count(), query_rules(parameters), sampler_kind(parameters));
    const std::size_t passes = (wanted + camera.count() - 1) / camera.count();
    const float radius = global_lookup(context, parameters, global_path_count(parameters, camera.count())).radius;
    auto importance = std::make_unique<ImportanceMap>(device, scene, camera.count(), 2 * passes * camera.count(), radius);
    for (std::size_t pass = 0; pass < passes; pass++) {
        const SamplerKey key = sampler_key(context.seed, (std::uint64_t(2) << 32) + pass); // beyond all iterations'
        camera.start(scene, pool, key);
        visible.trace(scene, camera, pool, key, radius);
        importance->add(visible.queries);
        if (!parameters.boolean("final_gather")) continue;
        gather.trace(scene, camera, visible, pool, key, radius);
        importance->add(gather.queries);
    }
    importance->build();
    rays += pool.rays_traced();
    return importance;
}

} // namespace sundog
