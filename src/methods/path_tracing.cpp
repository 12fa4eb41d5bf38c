#include "methods/path_tracing.h"

#include "methods/render_context.h"
#include "methods/standard_parameters.h"
#include "stages/regularization.h"

namespace sundog
{
namespace
{

class PathTracing final : public Method {
public:
    PathTracing(RenderContext& context, const Parameters& parameters, std::optional<RegularizationSchedule> schedule)
        : context_(context), rules_(path_rules(parameters)), schedule_(schedule), camera_(context.device, context.camera, context.filter, sampler_kind(parameters), context.scene.surface_options()),
          pool_(context.device, context.scene, camera_.count()), shadow_(context.device, context.scene, camera_.count(), true)
    {
        BuildOptions options = context.scene.surface_options();
        use_sampler(options, sampler_kind(parameters));
        if (schedule) use_regularization(options);
        shade_camera_path_ = Kernel(context.device, "shade_camera_path", "Shade camera paths", options);
    }

    void render_pass(std::uint64_t iteration) override
    {
        const SamplerKey key = sampler_key(context_.seed, iteration);
        const Regularization regularization = schedule_ ? schedule_->at(iteration) : Regularization{};
        camera_.start(context_.scene, pool_, key);
        camera_.record_first_hits(context_.scene, pool_, iteration, context_.film.first_hits);
        for (;;) {
            shade_camera_path_(pool_.items(), context_.scene.surfaces(), key, rules_, regularization, camera_.width(), camera_.height(), pool_.hits, pool_.active(),
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
    std::optional<RegularizationSchedule> schedule_;
    CameraPaths camera_;
    PathPool pool_;
    ShadowRays shadow_;
    Kernel shade_camera_path_;
};

} // namespace

std::unique_ptr<Method> make_path_tracing(RenderContext& context, const Parameters& parameters, std::optional<RegularizationSchedule> schedule)
{
    return std::make_unique<PathTracing>(context, parameters, schedule);
}

} // namespace sundog
