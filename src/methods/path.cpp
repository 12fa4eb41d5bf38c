// Path tracing [Kajiya 1986] with next-event estimation and BSDF sampling under multiple importance sampling
// [Veach and Guibas 1995]. Unbiased, but blind to caustics of small lights.
#include "methods/method.h"
#include "methods/render_context.h"
#include "methods/standard_parameters.h"

namespace sundog {
namespace {

class PathTracing final : public Method {
public:
    PathTracing(RenderContext& context, const Parameters& parameters)
        : context_(context), rules_(path_rules(parameters)), camera_(context.device, context.camera, context.filter, sampler_kind(parameters), context.scene.surface_options()),
          pool_(context.device, context.scene, camera_.count()), shadow_(context.device, context.scene, camera_.count(), true)
    {
        BuildOptions options = context.scene.surface_options();
        use_sampler(options, sampler_kind(parameters));
        shade_camera_path_ = Kernel(context.device, "shade_camera_path", "Shade camera paths", options);
    }

    void render_pass(std::uint64_t iteration) override
    {
        const SamplerKey key = sampler_key(context_.seed, iteration);
        camera_.start(context_.scene, pool_, key);
        camera_.record_first_hits(context_.scene, pool_, iteration, context_.film.first_hits);
        for (;;) {
            shade_camera_path_(pool_.items(), context_.scene.surfaces(), key, rules_, camera_.width(), camera_.height(), pool_.hits, pool_.active(),
                               pool_.active_count(), pool_.rays, pool_.paths, camera_.radiance, shadow_.rays, shadow_.radiance, pool_.flags);
            shadow_.trace(context_.scene, pool_);
            shadow_.add_unoccluded(pool_, camera_.radiance);
            if (!pool_.keep_alive()) break;
            pool_.trace(context_.scene);
        }
        context_.spectral.to_rgb(camera_.radiance);
        context_.film.accumulate(camera_.radiance);
    }

    MethodCounters counters() const override { return {0, context_.film.iterations() * camera_.count(), 0, pool_.rays_traced()}; }

    void serialize(StateArchive& archive) override { pool_.serialize(archive); }

private:
    RenderContext& context_;
    PathRules rules_;
    CameraPaths camera_;
    PathPool pool_;
    ShadowRays shadow_;
    Kernel shade_camera_path_;
};

const MethodRegistration registration({
    .name = "path",
    .title = "Path tracing",
    .paper = "Kajiya 1986, SIGGRAPH; Veach and Guibas 1995, SIGGRAPH",
    .estimator_class = "unbiased",
    .description = "Paths from the camera with next-event estimation and BSDF sampling under multiple importance sampling. Best for diffuse scenes with "
                   "large lights; cannot find small lights through glass.",
    .parameters = {max_depth_spec(), rr_depth_spec(5, "paths, by throughput"), sampler_spec(), light_choice_spec(), spectral_spec(), iterations_spec()},
    .traces_light = false,
    .create = [](RenderContext& context, const Parameters& parameters) -> std::unique_ptr<Method> { return std::make_unique<PathTracing>(context, parameters); },
});

} // namespace
} // namespace sundog
