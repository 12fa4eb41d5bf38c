// One radius for all queries of an iteration: fixed, or by the schedule of [Knaus and Zwicker 2011, ACM TOG 30(3), section 4],
// r_{i+1}^2 = r_i^2 (i + alpha) / (i + 1). No statistics are kept, so that iterations are independent.
#include "methods/radius_policy.h"

namespace sundog
{
namespace
{

class ScheduledRadii final : public RadiusPolicy
{
public:
    ScheduledRadii(RenderContext& context, const Parameters& parameters, double alpha)
        : first_radius_(first_radius(context, parameters)), alpha_(alpha), kernel_(density_kernel(parameters)),
          gather_(make_gather(context, "estimators/radiance_estimate.h", kernel_)),
          add_gathered_(context.device, "add_gathered", "Add gathered light")
    {
    }

    float widest(std::uint64_t iteration) const override
    {
        return static_cast<float>(scheduled_radius(first_radius_, alpha_, 2, iteration));
    }

    // Queries are born with the widest radius.
    void estimate(PhotonPass& pass, std::uint64_t) override
    {
        pass.estimate_bias(kernel_);
        pass.gather_photons(gather_);
        add_gathered_(pass.pixels(), pass.queries.queries, gather_.sums, static_cast<uint>(pass.pixels()), pass.inverse_paths(),
                      pass.camera.radiance);
    }

private:
    double first_radius_, alpha_;
    int kernel_;
    PhotonGather<> gather_;
    Kernel add_gathered_;
};

} // namespace

std::unique_ptr<RadiusPolicy> make_fixed_radii(RenderContext& context, const Parameters& parameters)
{
    return std::make_unique<ScheduledRadii>(context, parameters, 1.0);
}

std::unique_ptr<RadiusPolicy> make_scheduled_radii(RenderContext& context, const Parameters& parameters)
{
    return std::make_unique<ScheduledRadii>(context, parameters, parameters.real("alpha"));
}

} // namespace sundog
