// Light tracing with connections to the camera [Dutre, Lafortune and Willems 1993]: paths start at the lights,
// and every vertex that the lens can see adds to the pixel it is seen in.
#include "methods/method.h"
#include "methods/render_context.h"
#include "methods/standard_parameters.h"
#include "stages/splat_tracer.h"

#include <algorithm>

namespace sundog {
namespace {

class LightTracing final : public Method {
public:
    LightTracing(RenderContext& context, const Parameters& parameters)
        : context_(context), light_paths_(light_path_count(parameters, context.film.pixel_count())), max_depth_(path_rules(parameters).max_depth),
          camera_(context.device, context.camera, context.filter, sampler_kind(parameters), context.scene.surface_options()),
          pool_(context.device, context.scene, std::max(light_paths_, camera_.count())),
          splats_(context.device, context.scene, context.camera, light_paths_, camera_.count(), path_rules(parameters), sampler_kind(parameters)),
          add_visible_light_(context.device, "add_visible_light", "Add visible lights", context.scene.surface_options())
    {
    }

    void render_pass(std::uint64_t iteration) override
    {
        const SamplerKey key = sampler_key(context_.seed, iteration);
        camera_.start(context_.scene, pool_, key);
        if (context_.film.begin_first_hits(iteration)) camera_.record_first_hits(context_.scene, pool_, iteration, context_.film.first_hits);
        if (max_depth_ >= 1)
            add_visible_light_(camera_.count(), context_.scene.surfaces(), static_cast<uint>(camera_.count()), pool_.rays, pool_.hits, pool_.paths, camera_.radiance);
        splats_.trace(context_.scene, camera_, pool_, key);
        context_.spectral.to_rgb(camera_.radiance);
        context_.film.accumulate(camera_.radiance);
    }

    MethodCounters counters() const override
    {
        const std::uint64_t iterations = context_.film.iterations();
        return {iterations * light_paths_, iterations * camera_.count(), 0, pool_.rays_traced()};
    }

    void serialize(StateArchive& archive) override
    {
        pool_.serialize(archive);
        splats_.serialize(archive);
    }

private:
    RenderContext& context_;
    std::size_t light_paths_;
    uint max_depth_;
    CameraPaths camera_;
    PathPool pool_;
    SplatTracer splats_;
    Kernel add_visible_light_;
};

const MethodRegistration registration({
    .name = "ptracer",
    .title = "Light tracing",
    .paper = "Dutre, Lafortune and Willems 1993, Compugraphics",
    .estimator_class = "unbiased",
    .error_model = ErrorModel::variance,
    .description = "Paths from the lights, each vertex connected to the camera. Renders caustics on diffuse surfaces well; what is seen in mirrors or through "
                   "glass stays black.",
    .parameters = {photons_spec(), max_depth_spec(), rr_depth_spec(1, "light subpaths, by albedo"), sampler_spec(), spectral_spec(), iterations_spec()},
    .create = [](RenderContext& context, const Parameters& parameters) -> std::unique_ptr<Method> { return std::make_unique<LightTracing>(context, parameters); },
});

} // namespace
} // namespace sundog
