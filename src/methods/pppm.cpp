// Progressive photon mapping, a probabilistic approach [Knaus and Zwicker 2011, ACM TOG 30(3)]: independent
// photon-mapping renders with a shrinking radius, averaged. No statistics are kept from one to the next, so
// any kernel and any camera sampling will do: the reference among the progressive methods.
#include "methods/photon_pass.h"

#include <cmath>

namespace sundog
{
namespace
{

class ProbabilisticProgressivePhotonMapping final : public Method
{
public:
    ProbabilisticProgressivePhotonMapping(RenderContext& context, const Parameters& parameters)
        : context_(context), alpha_(parameters.real("alpha")), kernel_(density_kernel(parameters)), pass_(context, parameters),
          gather_(make_gather(context, "estimators/radiance_estimate.h", kernel_)),
          add_gathered_(context.device, "add_gathered", "Add gathered light")
    {
    }

    void render_pass(std::uint64_t iteration) override
    {
        const float radius = static_cast<float>(scheduled_radius(pass_.first_radius(), alpha_, 2, iteration));
        pass_.trace(iteration, radius);
        pass_.estimate_bias(kernel_);
        pass_.gather_photons(gather_);
        const float inverse_paths = 1.0f / static_cast<float>(pass_.light_paths());
        add_gathered_(pass_.pixels(), pass_.queries.queries, gather_.sums, static_cast<uint>(pass_.pixels()), inverse_paths,
                      pass_.camera.radiance);
        context_.spectral.to_rgb(pass_.camera.radiance);
        context_.film.accumulate(pass_.camera.radiance);
    }

    MethodCounters counters() const override { return pass_.counters(); }

    void serialize(StateArchive& archive) override { pass_.serialize(archive); }

private:
    RenderContext& context_;
    double alpha_;
    int kernel_;
    PhotonPass pass_;
    PhotonGather<> gather_;
    Kernel add_gathered_;
};

const MethodRegistration registration({
    .name = "pppm",
    .title = "Progressive photon mapping, a probabilistic approach",
    .paper = "Knaus and Zwicker 2011, ACM Transactions on Graphics 30(3)",
    .estimator_class = "consistent",
    .error_model = ErrorModel::bias_and_variance,
    .description = "Averages independent photon-mapping renders whose radius shrinks from one to the next. Renders caustics and light seen "
                   "through glass; "
                   "the reference among the progressive methods.",
    .parameters = {photons_spec(), radius_spec(), alpha_spec(), kernel_spec(), direct_spec(), light_choice_spec(), max_depth_spec(),
                   rr_depth_spec(1, "light subpaths, by albedo"), sampler_spec(), spectral_spec(), iterations_spec()},
    .create = [](RenderContext& context, const Parameters& parameters) -> std::unique_ptr<Method> {
        return std::make_unique<ProbabilisticProgressivePhotonMapping>(context, parameters);
    },
});

} // namespace
} // namespace sundog
