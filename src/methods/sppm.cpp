// Stochastic progressive photon mapping [Hachisuka and Jensen 2009, ACM TOG 28(5)]: statistics shared by all
// the points that a pixel sees, each iteration another one. Every pixel shrinks its own radius by the photons
// it finds, so dense caustics sharpen first.
#include "device/buffer_state.h"
#include "methods/photon_pass.h"

#include <cmath>
#include <numbers>

namespace sundog {
namespace {

class StochasticProgressivePhotonMapping final : public Method {
public:
    StochasticProgressivePhotonMapping(RenderContext& context, const Parameters& parameters)
        : context_(context), alpha_(static_cast<float>(parameters.real("alpha"))), pass_(context, parameters, "estimators/flux_sum.h", 0),
          set_query_radii_(context.device, "set_query_radii", "Set query radii"),
          update_progressive_pixels_(context.device, "update_progressive_pixels", "Update progressive pixels"),
          pixels_(context.device, std::vector<ProgressivePixel>(pass_.pixels(), first_statistics()), "progressive pixels")
    {
    }

    void render_pass(std::uint64_t iteration) override
    {
        const uint count = static_cast<uint>(pass_.pixels());
        pass_.trace(iteration, pass_.first_radius());
        set_query_radii_(count, pixels_, count, pass_.queries.queries);
        pass_.gather_photons();
        context_.spectral.to_rgb(pass_.camera.radiance);
        context_.spectral.to_rgb(pass_.queries.queries, pass_.gather.sums);
        const float inverse_paths = 1.0f / static_cast<float>(pass_.light_paths());
        update_progressive_pixels_(count, pass_.queries.queries, pass_.gather.sums, count, alpha_, inverse_paths, pixels_, pass_.camera.radiance);
        context_.film.accumulate(pass_.camera.radiance);
    }

    // L = direct light + tau / (pi r^2 N), eq. 10.
    void resolve(Image& image) const override
    {
        const std::vector<ProgressivePixel> pixels = pixels_.download();
        const double iterations = static_cast<double>(context_.film.iterations());
        const double emitted = iterations * static_cast<double>(pass_.light_paths());
        for (std::size_t path = 0; path < pixels.size(); path++) {
            const ProgressivePixel& p = pixels[path];
            const double density = 1.0 / (std::numbers::pi * static_cast<double>(p.radius_squared) * emitted);
            const auto radiance = [&](float tau, float direct, float direct_error) {
                return static_cast<float>((static_cast<double>(direct) + direct_error) / iterations + tau * density);
            };
            float* out = &image.pixels[context_.film.pixel_of_path(path) * image.channels.size()];
            out[0] = radiance(p.tau.x, p.direct.x, p.direct_error.x);
            out[1] = radiance(p.tau.y, p.direct.y, p.direct_error.y);
            out[2] = radiance(p.tau.z, p.direct.z, p.direct_error.z);
        }
    }

    MethodCounters counters() const override { return pass_.counters(); }

    void serialize(StateArchive& archive) override
    {
        pass_.serialize(archive);
        sundog::serialize(archive, "progressive pixels", pixels_);
    }

private:
    ProgressivePixel first_statistics() const
    {
        ProgressivePixel pixel{};
        pixel.radius_squared = pass_.first_radius() * pass_.first_radius();
        return pixel;
    }

    RenderContext& context_;
    float alpha_;
    PhotonPass pass_;
    Kernel set_query_radii_;
    Kernel update_progressive_pixels_;
    Buffer<ProgressivePixel> pixels_;
};

const MethodRegistration registration({
    .name = "sppm",
    .title = "Stochastic progressive photon mapping",
    .paper = "Hachisuka and Jensen 2009, ACM Transactions on Graphics 28(5)",
    .estimator_class = "consistent",
    .description = "Every pixel keeps its own radius, which shrinks with the photons it has found. Renders caustics and light seen through glass with "
                   "depth of field and antialiasing; a good default.",
    .parameters = {photons_spec(), radius_spec(), alpha_spec(), direct_spec(), light_choice_spec(), max_depth_spec(), rr_depth_spec(1, "light subpaths, by albedo"), sampler_spec(),
                   spectral_spec(), iterations_spec()},
    .create = [](RenderContext& context, const Parameters& parameters) -> std::unique_ptr<Method> {
        return std::make_unique<StochasticProgressivePhotonMapping>(context, parameters);
    },
});

} // namespace
} // namespace sundog
