// Adaptive progressive photon mapping [Kaplanyan and Dachsbacher 2013, ACM TOG 32(2)]: every pixel learns the variance of
// its estimates and, from the Laplacian of its radiance, their bias, and chooses the radius that makes the mean squared
// error of all iterations together least. The Laplacian has a radius of its own, h_i ~ i^(-1/10), the optimal rate for
// second derivatives in the plane. A radius follows from iterations before it alone, so it is independent of the photons
// that it gathers.
#include "device/buffer_state.h"
#include "methods/photon_pass.h"
#include "shared/adaptive_radius.h"

#include <cmath>
#include <numbers>

namespace sundog
{
namespace
{

// Radii lie between a twentieth of the global schedule's and the schedule's own.
constexpr double smallest_share = 0.05;

class AdaptiveProgressivePhotonMapping final : public Method
{
public:
    AdaptiveProgressivePhotonMapping(RenderContext& context, const Parameters& parameters)
        : context_(context), kernel_(density_kernel(parameters)), pass_(context, parameters, true),
          gather_(make_gather(context, "estimators/radiance_estimate.h", kernel_)),
          gather_errors_(make_gather<ErrorSum>(context, "estimators/error_estimate.h")),
          set_query_radii_(context.device, "set_query_radii", "Set query radii", BuildOptions{{{"PIXEL_STATISTICS", "AdaptivePixel"}}, {}}),
          add_gathered_(context.device, "add_gathered", "Add gathered light"), learn_radii_(context.device, "learn_radii", "Learn radii"),
          pixels_(context.device, std::vector<AdaptivePixel>(pass_.pixels(), {pass_.first_radius() * pass_.first_radius(), 0, 0, 0, 0}),
                  "adaptive pixels")
    {
        if (context.film.errors) bias_.emplace(context);
    }

    void render_pass(std::uint64_t iteration) override
    {
        const uint count = static_cast<uint>(pass_.pixels());
        const double done = static_cast<double>(iteration + 1);
        // Laplacians need wider disks: at twice the largest radius their noise does not keep radii below it where light is even.
        pass_.trace(iteration, laplacian_radius(pass_.first_radius(), iteration));
        pass_.gather_photons(gather_errors_);

        set_query_radii_(count, pixels_, count, pass_.queries.queries);
        const float inverse_paths = 1.0f / static_cast<float>(pass_.light_paths());
        if (bias_) {
            bias_->add(pass_.queries.queries, gather_errors_.sums, {kernel_, inverse_paths});
            context_.spectral.to_rgb(context_.film.errors->bias);
        }
        pass_.gather_photons(gather_);
        add_gathered_(count, pass_.queries.queries, gather_.sums, count, inverse_paths, pass_.camera.radiance);
        context_.spectral.to_rgb(pass_.camera.radiance);
        context_.film.accumulate(pass_.camera.radiance);

        learn_radii_(count, pass_.queries.queries, gather_errors_.sums, schedule(done), count, pixels_);
    }

    MethodCounters counters() const override { return pass_.counters(); }

    void serialize(StateArchive& archive) override
    {
        pass_.serialize(archive);
        sundog::serialize(archive, "adaptive pixels", pixels_);
    }

private:
    AdaptiveSchedule schedule(double iterations_done) const
    {
        const double n = kernel_; // of (1 - t^2)^n
        const double largest = pass_.first_radius() * std::pow(iterations_done + 1.0, -1.0 / 6);
        return {static_cast<float>(iterations_done), static_cast<float>(pass_.light_paths()),
                static_cast<float>(0.5 / (n + 2.0)), static_cast<float>((n + 1.0) * (n + 1.0) / (std::numbers::pi * (2.0 * n + 1.0))),
                static_cast<float>(largest),         static_cast<float>(smallest_share * largest)};
    }

    RenderContext& context_;
    int kernel_;
    PhotonPass pass_;
    PhotonGather<> gather_;
    PhotonGather<ErrorSum> gather_errors_;
    Kernel set_query_radii_;
    Kernel add_gathered_;
    Kernel learn_radii_;
    Buffer<AdaptivePixel> pixels_;
    std::optional<BiasTerm<ErrorSum>> bias_; // where errors are asked for
};

const MethodRegistration registration({
    .name = "appm",
    .title = "Adaptive progressive photon mapping",
    .paper = "Kaplanyan and Dachsbacher 2013, ACM Transactions on Graphics 32(2)",
    .estimator_class = "consistent",
    .error_model = ErrorModel::bias_and_variance,
    .description = "Every pixel learns bias and variance of its estimates and chooses the radius that balances them, at most that of the "
                   "global schedule. "
                   "`radius` is the largest: choose it wide.",
    .parameters = {photons_spec(), radius_spec(), kernel_spec(), direct_spec(), light_choice_spec(), max_depth_spec(),
                   rr_depth_spec(1, "light subpaths, by albedo"), sampler_spec(), spectral_spec(), iterations_spec()},
    .create = [](RenderContext& context, const Parameters& parameters) -> std::unique_ptr<Method> {
        return std::make_unique<AdaptiveProgressivePhotonMapping>(context, parameters);
    },
});

} // namespace
} // namespace sundog
