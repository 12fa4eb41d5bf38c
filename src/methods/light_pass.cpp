#include "methods/light_pass.h"

namespace sundog
{

LightPass::LightPass(RenderContext& context, const Parameters& parameters, bool direct_light_elsewhere)
    : scene_(context.scene), light_paths_(light_path_count(parameters, context.film.pixel_count())),
      photons_(context.device, context.scene, {light_paths_, path_rules(parameters), direct_light_elsewhere, sampler_kind(parameters)}),
      map(context.device, context.scene.bounds())
{
}

void LightPass::trace(PathPool& pool, SamplerKey key, float radius)
{
    stored_ = photons_.trace(scene_, pool, key, map.lend_room(light_paths_));
    map.build(photons_.photons(), stored_, radius);
    photons_stored_ += stored_;
}

void LightPass::serialize(StateArchive& archive)
{
    archive.count("photons stored", photons_stored_);
    photons_.serialize(archive);
}

PathRules query_rules(const Parameters& parameters)
{
    constexpr uint rr_depth = 8;
    return {path_rules(parameters).max_depth, rr_depth};
}

float first_radius(const RenderContext& context, const Parameters& parameters, double target_pixels)
{
    return initial_radius(parameters, context.scene.radius(), light_path_count(parameters, context.film.pixel_count()),
                          pixel_footprint(context.camera, context.scene.bounds()), target_pixels);
}

} // namespace sundog
