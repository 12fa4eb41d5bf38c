#include "methods/path_tracing.h"

#include "methods/render_context.h"
#include "methods/standard_parameters.h"
#include "stages/path_tracer.h"

namespace sundog
{
namespace
{

class PathTracing final : public Method {
public:
    PathTracing(RenderContext& context, const Parameters& parameters, std::optional<RegularizationSchedule> schedule)
        : context_(context), schedule_(schedule), camera_(context.device, context.camera, context.filter, sampler_kind(parameters), context.scene.surface_options()),
          pool_(context.device, context.scene, camera_.count()),
          tracer_(context.device, context.scene, camera_.count(), path_rules(parameters), sampler_kind(parameters), schedule.has_value())
    {
    }

    void render_pass(std::uint64_t iteration) override
    {
        const SamplerKey key = sampler_key(context_.seed, iteration);
        const Regularization regularization = schedule_ ? schedule_->at(iteration) : Regularization{};
        camera_.start(context_.scene, pool_, key);
        if (context_.film.begin_first_hits(iteration)) camera_.record_first_hits(context_.scene, pool_, iteration, context_.film.first_hits);
        tracer_.trace(context_.scene, camera_, pool_, key, regularization);
        context_.spectral.to_rgb(camera_.radiance);
        context_.film.accumulate(camera_.radiance);
    }

    MethodCounters counters() const override { return {0, context_.film.iterations() * camera_.count(), 0, pool_.rays_traced()}; }

    void serialize(StateArchive& archive) override { pool_.serialize(archive); }

private:
    RenderContext& context_;
    std::optional<RegularizationSchedule> schedule_;
    CameraPaths camera_;
    PathPool pool_;
    PathTracer tracer_;
};

} // namespace

std::unique_ptr<Method> make_path_tracing(RenderContext& context, const Parameters& parameters, std::optional<RegularizationSchedule> schedule)
{
    return std::make_unique<PathTracing>(context, parameters, schedule);
}

} // namespace sundog
