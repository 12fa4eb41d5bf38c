// Stochastic progressive photon mapping [Hachisuka and Jensen 2009, ACM TOG 28(5)]: statistics shared by all
// the points that a pixel sees, each iteration another one. Every pixel shrinks its own radius by the photons
// it finds, so dense caustics sharpen first.
#include "methods/averaged_photon_mapping.h"
#include "methods/photon_pass.h"
#include "methods/progressive_statistics.h"
#include "methods/radius_policy.h"

namespace sundog
{
namespace
{

class StochasticProgressivePhotonMapping final : public Method
{
public:
    StochasticProgressivePhotonMapping(RenderContext& context, const Parameters& parameters)
        : context_(context), pass_(context, parameters), gather_(make_gather(context, "estimators/flux_sum.h")),
          statistics_(context.device, pass_.pixels(), pass_.first_radius(), parameters.real("alpha"), DirectLight::varying)
    {
    }

    void render_pass(std::uint64_t iteration) override
    {
        pass_.trace(iteration, pass_.first_radius());
        statistics_.set_radii(pass_.queries.queries);
        pass_.estimate_bias(0); // the uniform kernel
        pass_.gather_photons(gather_);
        context_.spectral.to_rgb(pass_.camera.radiance);
        context_.spectral.to_rgb(pass_.queries.queries, gather_.sums);
        pass_.begin_update();
        statistics_.update(pass_.queries.queries, gather_.sums, pass_.camera.radiance, pass_.inverse_paths());
        context_.film.accumulate(pass_.camera.radiance);
    }

    void resolve(Image& image) const override
    {
        clear_radiance(image);
        statistics_.add_radiance(image, context_.film, pass_.camera.radiance, pass_.light_paths(), 1.0);
    }

    MethodCounters counters() const override { return pass_.counters(); }

    void serialize(StateArchive& archive) override
    {
        pass_.serialize(archive);
        statistics_.serialize(archive);
    }

private:
    RenderContext& context_;
    PhotonPass pass_;
    PhotonGather<> gather_;
    ProgressiveStatistics statistics_;
};

// Flux that has been found is rescaled to smaller disks as if it lay evenly in them: the uniform kernel. Radii that follow
// from anything else than the count of photons take the mean of iterations in place of that.
std::unique_ptr<Method> make_sppm(RenderContext& context, const Parameters& parameters)
{
    if (parameters.text("radius_policy") != "local") return make_averaged_photon_mapping(context, parameters);
    refuse_parameters_of_other_policies(parameters);
    if (parameters.text("kernel") != "uniform")
        parameters.refuse(
            "kernel",
            "sppm rescales the flux that it has found, which takes kernel=uniform; for another kernel choose pppm (-m pppm), with "
            "radius_policy=local if need be");
    return std::make_unique<StochasticProgressivePhotonMapping>(context, parameters);
}

const MethodRegistration registration({
    .name = "sppm",
    .title = "Stochastic progressive photon mapping",
    .paper = "Hachisuka and Jensen 2009, ACM Transactions on Graphics 28(5)",
    .estimator_class = "consistent",
    .error_model = ErrorModel::bias_and_variance,
    .description =
        "Every pixel keeps its own radius, which shrinks with the photons it has found. Renders caustics and light seen through glass with "
        "depth of field and antialiasing; a good default.",
    .parameters = averaged_specs("uniform", "local"),
    .create = make_sppm,
});

} // namespace
} // namespace sundog
