// Adaptive progressive photon mapping [Kaplanyan and Dachsbacher 2013, ACM TOG 32(2)]: every pixel learns the variance of
// its estimates and, from the Laplacian of its radiance, their bias, and chooses the radius that makes the mean squared
// error of all iterations together least. The Laplacian has a radius of its own, h_i ~ i^(-1/10), the optimal rate for
// second derivatives in the plane. A radius follows from iterations before it alone, so it is independent of the photons
// that it gathers.
#include "device/buffer_state.h"
#include "methods/photon_pass.h"
#include "shared/adaptive_radius.h"

#include <cmath>

namespace sundog
{
namespace
{

// Radii lie between a twentieth of the global schedule's and the schedule's own.
constexpr double smallest_share = 0.05;
// Laplacians need wider disks: at twice the largest radius their noise does not keep radii below it where light is even.
constexpr double laplacian_radius = 2.0;

class AdaptiveProgressivePhotonMapping final : public Method
{
public:
    AdaptiveProgressivePhotonMapping(RenderContext& context, const Parameters& parameters)
        : context_(context), kernel_(density_kernel(parameters)), pass_(context, parameters),
          gather_(make_gather<MomentSum>(context, "estimators/moment_estimate.h", kernel_)),
          gather_laplacian_(make_gather(context, "estimators/laplacian_estimate.h")),
          set_query_radii_(context.device, "set_query_radii", "Set query radii", BuildOptions{{{"PIXEL_STATISTICS", "AdaptivePixel"}}, {}}),
          learn_radii_(context.device, "learn_radii", "Learn radii"),
          pixels_(context.device, std::vector<AdaptivePixel>(pass_.pixels(), {pass_.first_radius() * pass_.first_radius(), 0, 0, 0}),
                  "adaptive pixels")
    {
    }

    void render_pass(std::uint64_t iteration) override
    {
        const uint count = static_cast<uint>(pass_.pixels());
        const double done = static_cast<double>(iteration + 1);
        pass_.trace(iteration, static_cast<float>(laplacian_radius * pass_.first_radius() * std::pow(done, -0.1)));
        pass_.gather_photons(gather_laplacian_);
        set_query_radii_(count, pixels_, count, pass_.queries.queries);
        pass_.gather_photons(gather_);

        const double largest = pass_.first_radius() * std::pow(done + 1.0, -1.0 / 6);
        const AdaptiveSchedule schedule{static_cast<float>(done), static_cast<float>(pass_.light_paths()),
                                        0.5f / static_cast<float>(kernel_ + 2), static_cast<float>(largest),
                                        static_cast<float>(largest * smallest_share)};
        learn_radii_(count, pass_.queries.queries, gather_.sums, gather_laplacian_.sums, schedule, count, pixels_, pass_.camera.radiance);
        context_.film.accumulate(pass_.camera.radiance);
    }

    MethodCounters counters() const override { return pass_.counters(); }

    void serialize(StateArchive& archive) override
    {
        pass_.serialize(archive);
        sundog::serialize(archive, "adaptive pixels", pixels_);
    }

private:
    RenderContext& context_;
    int kernel_;
    PhotonPass pass_;
    PhotonGather<MomentSum> gather_;
    PhotonGather<> gather_laplacian_;
    Kernel set_query_radii_;
    Kernel learn_radii_;
    Buffer<AdaptivePixel> pixels_;
};

const MethodRegistration registration({
    .name = "appm",
    .title = "Adaptive progressive photon mapping",
    .paper = "Kaplanyan and Dachsbacher 2013, ACM Transactions on Graphics 32(2)",
    .estimator_class = "consistent",
    .description = "Every pixel learns bias and variance of its estimates and chooses the radius that balances them, at most that of the "
                   "global schedule. "
                   "`radius` is the largest: choose it wide.",
    .parameters = {photons_spec(), radius_spec(), kernel_spec(), direct_spec(), max_depth_spec(),
                   rr_depth_spec(1, "light subpaths, by albedo"), sampler_spec(), iterations_spec()},
    .create = [](RenderContext& context, const Parameters& parameters) -> std::unique_ptr<Method> {
        return std::make_unique<AdaptiveProgressivePhotonMapping>(context, parameters);
    },
});

} // namespace
} // namespace sundog
