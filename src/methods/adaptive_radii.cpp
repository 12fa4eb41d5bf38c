// Every pixel learns the variance of its estimates and, from the Laplacian of its radiance, their bias, and chooses the radius
// that makes the mean squared error of all iterations together least [Kaplanyan and Dachsbacher 2013, ACM TOG 32(2)]. The
// Laplacian has a radius of its own, h_i ~ i^(-1/10), the optimal rate for second derivatives in the plane.
#include "device/buffer_state.h"
#include "methods/radius_policy.h"
#include "shared/adaptive_radius.h"

#include <cmath>
#include <numbers>

namespace sundog
{
namespace
{

// Radii lie between a twentieth of the global schedule's and the schedule's own.
constexpr double smallest_share = 0.05;

class AdaptiveRadii final : public RadiusPolicy
{
public:
    AdaptiveRadii(RenderContext& context, const Parameters& parameters)
        : context_(context), first_radius_(first_radius(context, parameters)), kernel_(density_kernel(parameters)),
          gather_(make_gather(context, "estimators/radiance_estimate.h", kernel_)),
          gather_errors_(make_gather<ErrorSum>(context, "estimators/error_estimate.h")),
          set_query_radii_(context.device, "set_query_radii", "Set query radii", BuildOptions{{{"PIXEL_STATISTICS", "AdaptivePixel"}}, {}}),
          add_gathered_(context.device, "add_gathered", "Add gathered light"), learn_radii_(context.device, "learn_radii", "Learn radii"),
          pixels_(context.device, std::vector<AdaptivePixel>(context.film.pixel_count(), {first_radius_ * first_radius_, 0, 0, 0, 0}),
                  "adaptive pixels")
    {
        if (context.film.errors) bias_.emplace(context);
    }

    // Laplacians need wider disks: at twice the largest radius their noise does not keep radii below it where light is even.
    float widest(std::uint64_t iteration) const override { return laplacian_radius(first_radius_, iteration); }

    void estimate(PhotonPass& pass, std::uint64_t iteration) override
    {
        const uint count = static_cast<uint>(pass.pixels());
        pass.gather_photons(gather_errors_); // queries are born with the widest radius
        set_query_radii_(count, pixels_, count, pass.queries.queries);
        if (bias_) {
            bias_->add(pass.queries.queries, gather_errors_.sums, {kernel_, pass.inverse_paths()});
            context_.spectral.to_rgb(context_.film.errors->bias);
        }
        pass.gather_photons(gather_);
        add_gathered_(count, pass.queries.queries, gather_.sums, count, pass.inverse_paths(), pass.camera.radiance);
        pass.begin_update();
        learn_radii_(count, pass.queries.queries, gather_errors_.sums, schedule(static_cast<double>(iteration + 1), pass.light_paths()),
                     count, pixels_);
    }

    void serialize(StateArchive& archive) override
    {
        sundog::serialize(archive, "adaptive pixels", pixels_, [this](const AdaptivePixel& pixel) {
            return is_shrunk(pixel.radius_squared, first_radius_) && std::isfinite(pixel.second_moment) && std::isfinite(pixel.laplacian) &&
                   pixel.second_moment >= 0.0f && pixel.laplacian_deviation >= 0.0f && pixel.photons >= 0.0f;
        });
    }

private:
    AdaptiveSchedule schedule(double iterations_done, std::size_t light_paths) const
    {
        const double n = kernel_; // of (1 - t^2)^n
        const double largest = first_radius_ * std::pow(iterations_done + 1.0, -1.0 / 6);
        return {static_cast<float>(iterations_done), static_cast<float>(light_paths),
                static_cast<float>(0.5 / (n + 2.0)), static_cast<float>((n + 1.0) * (n + 1.0) / (std::numbers::pi * (2.0 * n + 1.0))),
                static_cast<float>(largest),         static_cast<float>(smallest_share * largest)};
    }

    RenderContext& context_;
    float first_radius_;
    int kernel_;
    PhotonGather<> gather_;
    PhotonGather<ErrorSum> gather_errors_;
    Kernel set_query_radii_;
    Kernel add_gathered_;
    Kernel learn_radii_;
    Buffer<AdaptivePixel> pixels_;
    std::optional<BiasTerm<ErrorSum>> bias_; // where errors are asked for
};

} // namespace

std::unique_ptr<RadiusPolicy> make_adaptive_radii(RenderContext& context, const Parameters& parameters)
{
    return std::make_unique<AdaptiveRadii>(context, parameters);
}

} // namespace sundog
